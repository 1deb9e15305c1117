// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/corners.h"

#include <cmath>
#include <cstddef>
#include <optional>

namespace stucco {
namespace {

// Where the line of `before`, run on, meets that of `after`, run back; both keep their direction.
std::optional<Eigen::Vector2d> CornerOf(const Segment2d& before, const Segment2d& after) {
  constexpr double kParallel = 0.2;  // sine
  const Eigen::Vector2d along = (before.b - before.a).normalized();
  const Eigen::Vector2d onwards = (after.b - after.a).normalized();
  const double turn = Cross(along, onwards);
  if (!(std::abs(turn) > kParallel)) return std::nullopt;
  const Eigen::Vector2d corner = before.a + along * (Cross(after.a - before.a, onwards) / turn);
  if (along.dot(corner - before.a) <= 0 || onwards.dot(after.b - corner) <= 0) return std::nullopt;
  return corner;
}

}  // namespace

Ring WithCorners(Ring ring, const std::function<bool(const Segment2d&)>& is_held, double reach) {
  for (size_t i = 0; i < ring.size() && ring.size() > 3;) {
    const size_t count = ring.size();
    const auto edge = [&](size_t k) { return Segment2d{ring[k % count], ring[(k + 1) % count]}; };
    const Segment2d before = edge(i + count - 1), cut = edge(i), after = edge(i + 1);
    std::optional<Eigen::Vector2d> corner;
    if (!is_held(cut) && is_held(before) && is_held(after)) corner = CornerOf(before, after);
    if (corner && (*corner - cut.a).norm() < reach && (*corner - cut.b).norm() < reach) {
      ring[i] = *corner;
      ring.erase(ring.begin() + static_cast<ptrdiff_t>((i + 1) % count));
    } else {
      ++i;
    }
  }
  return ring;
}

}  // namespace stucco
