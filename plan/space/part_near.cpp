// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/part_near.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace stucco::plan {

using Eigen::Vector2d;

namespace {

void Widen(std::optional<Interval>& part, double from, double to) {
  from = std::max(from, 0.0);
  to = std::min(to, 1.0);
  if (!(from <= to)) return;
  part =
      part ? Interval{std::min(part->from_m, from), std::max(part->to_m, to)} : Interval{from, to};
}

// Where |s(t) - centre| < radius.
void WidenByDisc(std::optional<Interval>& part, const Segment2d& s, const Vector2d& centre,
                 double radius) {
  const Vector2d d = s.b - s.a;
  const Vector2d m = s.a - centre;
  const double a = d.squaredNorm();
  const double c = m.squaredNorm() - radius * radius;
  if (!(a > 0)) {
    if (c < 0) Widen(part, 0, 1);
    return;
  }
  const double b = m.dot(d);
  const double root = b * b - a * c;
  if (!(root > 0)) return;
  Widen(part, (-b - std::sqrt(root)) / a, (-b + std::sqrt(root)) / a);
}

// Where from < offset + t * slope < to, cut with [low, high].
void Clip(double offset, double slope, const Interval& within, Interval& part) {
  if (slope == 0) {
    if (!(offset > within.from_m && offset < within.to_m)) part = {1, 0};
    return;
  }
  double t0 = (within.from_m - offset) / slope;
  double t1 = (within.to_m - offset) / slope;
  if (t0 > t1) std::swap(t0, t1);
  part.from_m = std::max(part.from_m, t0);
  part.to_m = std::min(part.to_m, t1);
}

}  // namespace

std::optional<Interval> PartNear(const Segment2d& s, const Segment2d& t, double radius) {
  std::optional<Interval> part;
  WidenByDisc(part, s, t.a, radius);
  WidenByDisc(part, s, t.b, radius);
  const Vector2d v = t.b - t.a;
  const double length = v.norm();
  if (!(length > 0)) return part;
  const Vector2d u = v / length;
  const Vector2d d = s.b - s.a;
  Interval beside{0, 1};
  Clip((s.a - t.a).dot(u), d.dot(u), {0, length}, beside);
  Clip(Cross(u, s.a - t.a), Cross(u, d), {-radius, radius}, beside);
  if (beside.from_m <= beside.to_m) Widen(part, beside.from_m, beside.to_m);
  return part;
}

}  // namespace stucco::plan
