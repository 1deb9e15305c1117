// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/space/obstacles.h"

#include <limits>

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

// A path that follows the floor may dip below it by the rounding of interpolated heights.
constexpr double kFloorTolerance_m = 1e-6;

// The largest value on [0, 1] of the polynomial of degree two with these values at 0, 1/2, 1.
double LargestValue(double start, double middle, double end) {
  const double square = 2 * (start - 2 * middle + end);
  const double linear = 4 * middle - 3 * start - end;
  const double largest = std::max(start, end);
  if (!(square < 0)) return largest;
  const double peak = -linear / (2 * square);
  return peak > 0 && peak < 1 ? start - linear * linear / (4 * square) : largest;
}

bool IsAboveFloor(const Site& site, const Vector3d& p, const Vector3d& q) {
  const auto depth = [&](double t) {
    const Vector3d at = p + t * (q - p);
    return site.FloorAt(at.head<2>()) - at.z();
  };
  if (!(depth(0) <= kFloorTolerance_m && depth(1) <= kFloorTolerance_m)) return false;
  if (site.terrain.IsFlat()) return true;
  return ForTerrainPieces(site.terrain, {p.head<2>(), q.head<2>()}, [&](double from, double to) {
    return LargestValue(depth(from), depth(0.5 * (from + to)), depth(to)) <= kFloorTolerance_m;
  });
}

}  // namespace

Obstacles::Obstacles(const Site& site) : site_(&site), radius_m_(site.d_min_m + kSafetyMargin_m) {
  for (const Footprint& footprint : site.footprints) {
    footprints_.Add(footprint.outline, footprint.blocked_to_m);
  }
  for (const auto* zones : {&site.no_fly, &site.closed_off}) {
    for (const Polygon& zone : *zones) no_fly_.Add(zone, std::numeric_limits<double>::infinity());
  }
  footprints_.Index();
  no_fly_.Index();
}

bool Obstacles::IsFree(const Vector3d& p) const {
  return p.allFinite() && p.z() >= site_->FloorAt(p.head<2>()) - kFloorTolerance_m &&
         !footprints_.Touches(p, p, radius_m_) && !no_fly_.Touches(p, p, kSafetyMargin_m);
}

// The lowest point decides: what is blocked at a height is blocked below it.
bool Obstacles::IsFree(const Vector2d& p, Interval z) const {
  return IsFree(Vector3d(p.x(), p.y(), std::min(z.from_m, z.to_m)));
}

bool Obstacles::IsFreeBetween(const Vector3d& p, const Vector3d& q) const {
  return p.allFinite() && q.allFinite() && !footprints_.Touches(p, q, radius_m_) &&
         !no_fly_.Touches(p, q, kSafetyMargin_m) && IsAboveFloor(*site_, p, q);
}

double Obstacles::HorizontalDistance(const Vector2d& p, double z) const {
  return footprints_.Distance(p, z);
}

}  // namespace stucco::plan
