// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/pinches.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <numbers>

namespace stucco {
namespace {

constexpr double kApart_m = 0.03;  // less than maps, fits and clouds are exact to
constexpr double kTouch_m = 0.01;

// One corner of the parts.
struct CornerPlace {
  size_t part = 0, ring = 0, corner = 0;
};

Eigen::Vector2d& At(std::vector<Polygon>& parts, const CornerPlace& place) {
  return parts[place.part].rings[place.ring][place.corner];
}

bool Covers(const std::vector<Polygon>& parts, const Eigen::Vector2d& p) {
  return std::ranges::any_of(parts, [&](const Polygon& part) { return Contains(part, p); });
}

// Whether inside and outside alternate more than once around a point. What is narrower than a
// sixteenth of the way round may be the seam between two parts.
bool IsPinch(const std::vector<Polygon>& parts, const Eigen::Vector2d& p) {
  constexpr size_t kDirections = 32;
  std::array<bool, kDirections> inside{};
  for (size_t i = 0; i < kDirections; ++i) {
    // No wall of a house drawn along the axes lies in any of these directions.
    const double turn = 2 * std::numbers::pi * (static_cast<double>(i) + 0.3) / kDirections;
    inside[i] = Covers(parts, p + kTouch_m * Eigen::Vector2d(std::cos(turn), std::sin(turn)));
  }
  std::array<bool, kDirections> smooth = inside;
  for (size_t i = 0; i < kDirections; ++i) {
    const bool before = inside[(i + kDirections - 1) % kDirections];
    if (before == inside[(i + 1) % kDirections]) smooth[i] = before;
  }
  int changes = 0;
  for (size_t i = 0; i < kDirections; ++i) changes += smooth[i] != smooth[(i + 1) % kDirections];
  return changes > 2;
}

// Half way between the edges at a corner, towards the side that is less than half way round.
Eigen::Vector2d Bisector(const Ring& ring, size_t corner) {
  const Eigen::Vector2d& p = ring[corner];
  const Eigen::Vector2d back = (ring[(corner + ring.size() - 1) % ring.size()] - p).normalized();
  const Eigen::Vector2d on = (ring[(corner + 1) % ring.size()] - p).normalized();
  const Eigen::Vector2d between = back + on;
  constexpr double kStraight = 1e-3;
  if (between.norm() > kStraight) return between.normalized();
  return Eigen::Vector2d(on - back).unitOrthogonal();
}

// Whether the edges at a corner come nowhere near the other edges of its part.
bool IsFree(const Polygon& part, const CornerPlace& place) {
  const Ring& moved = part.rings[place.ring];
  const size_t count = moved.size(), before = (place.corner + count - 1) % count;
  const Segment2d in{moved[before], moved[place.corner]};
  const Segment2d out{moved[place.corner], moved[(place.corner + 1) % count]};
  for (size_t r = 0; r < part.rings.size(); ++r) {
    const Ring& ring = part.rings[r];
    for (size_t i = 0; i < ring.size(); ++i) {
      const Segment2d edge{ring[i], ring[(i + 1) % ring.size()]};
      const auto meets = [&](size_t k) {  // the edge that begins at corner k, or the one beside it
        return r == place.ring && (i == k || i == (k + 1) % count || i == (k + count - 1) % count);
      };
      constexpr double kNear_m2 = kTouch_m * kTouch_m;
      if (!meets(before) && SquaredDistance(in, edge) < kNear_m2) return false;
      if (!meets(place.corner) && SquaredDistance(out, edge) < kNear_m2) return false;
    }
  }
  return true;
}

// The corners that lie there.
std::vector<CornerPlace> CornersAt(const std::vector<Polygon>& parts, const Eigen::Vector2d& p) {
  std::vector<CornerPlace> places;
  for (size_t part = 0; part < parts.size(); ++part) {
    for (size_t r = 0; r < parts[part].rings.size(); ++r) {
      const Ring& ring = parts[part].rings[r];
      for (size_t i = 0; i < ring.size(); ++i) {
        if ((ring[i] - p).norm() < kTouch_m) places.push_back({part, r, i});
      }
    }
  }
  return places;
}

// Draws back the first of the corners at a pinch that opens it.
void Open(std::vector<Polygon>& parts, const Eigen::Vector2d& pinch) {
  for (const CornerPlace& place : CornersAt(parts, pinch)) {
    Eigen::Vector2d& corner = At(parts, place);
    const Eigen::Vector2d was = corner;
    const Eigen::Vector2d aside = Bisector(parts[place.part].rings[place.ring], place.corner);
    for (const double side : {1.0, -1.0}) {
      corner = was + side * kApart_m * aside;
      const bool opens =
          IsFree(parts[place.part], place) && !IsPinch(parts, was) && !IsPinch(parts, corner);
      if (opens) return;
    }
    corner = was;
  }
}

}  // namespace

void OpenPinches(std::vector<Polygon>& parts) {
  for (size_t part = 0; part < parts.size(); ++part) {
    for (size_t r = 0; r < parts[part].rings.size(); ++r) {
      for (size_t i = 0; i < parts[part].rings[r].size(); ++i) {
        const Eigen::Vector2d corner = parts[part].rings[r][i];
        if (IsPinch(parts, corner)) Open(parts, corner);
      }
    }
  }
}

}  // namespace stucco
