// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/corners.h"

#include <cmath>

#include "survey/geometry2d.h"

namespace stucco::plan {

using Eigen::Vector2d;

namespace {

// A turn below this bends no path by more than it bends a straight line by rounding.
constexpr double kLeastTurn_rad = 1e-9;

Vector2d Rotated(const Vector2d& v, double angle_rad) {
  const double c = std::cos(angle_rad);
  const double s = std::sin(angle_rad);
  return {c * v.x() - s * v.y(), s * v.x() + c * v.y()};
}

void AddArc(const Vector2d& centre, const Vector2d& in, double turn, double radius, double step_rad,
            std::vector<Corner>& corners) {
  const int sides = std::max(1, static_cast<int>(std::ceil(turn / step_rad - 1e-9)));
  const double step = turn / sides;
  const double reach = radius / std::cos(0.5 * step);
  for (int k = 0; k < sides; ++k) {
    const Vector2d before = Rotated(in, step * k);
    const Vector2d middle = Rotated(in, step * (k + 0.5));
    const Vector2d outward(middle.y(), -middle.x());
    corners.push_back({centre + reach * outward, before, Rotated(in, step * (k + 1))});
  }
}

// Without repeated points.
std::vector<Vector2d> Distinct(const Ring& ring) {
  std::vector<Vector2d> points;
  for (const Vector2d& point : ring) {
    if (points.empty() || point != points.back()) points.push_back(point);
  }
  while (points.size() > 1 && points.front() == points.back()) points.pop_back();
  return points;
}

}  // namespace

std::vector<Corner> DilatedCorners(const Polygon& outline, double radius, double step_rad) {
  std::vector<Corner> corners;
  for (const Ring& ring : outline.rings) {
    const std::vector<Vector2d> points = Distinct(ring);
    const size_t n = points.size();
    if (n < 2) continue;
    for (size_t k = 0; k < n; ++k) {
      const Vector2d in = (points[k] - points[(k + n - 1) % n]).normalized();
      const Vector2d out = (points[(k + 1) % n] - points[k]).normalized();
      double turn = std::atan2(Cross(in, out), in.dot(out));
      // A spike turns back; which way is lost to rounding, and only outwards is safe.
      if (in.dot(out) < 0 && std::abs(Cross(in, out)) < 1e-12) turn = std::abs(turn);
      if (turn > kLeastTurn_rad) AddArc(points[k], in, turn, radius, step_rad, corners);
    }
  }
  return corners;
}

}  // namespace stucco::plan
