// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "plan/space/prisms.h"
#include "site/site.h"

namespace stucco::plan {

// What "free" leaves beyond the limit itself, so that rounding here and in whatever a position is
// written to never takes it over the limit.
constexpr double kSafetyMargin_m = 1e-3;

// Where the drone may be. A position is free when it is outside every no-fly polygon and
// what these part from home, at least
// d_min (horizontally) from every footprint that is blocked at its height, and not below the lowest
// altitude. Borders count as not free. Any number of threads may ask; nothing is allocated.
class Obstacles {
 public:
  // Keeps a reference to the site's terrain.
  explicit Obstacles(const Site& site);

  bool IsFree(const Eigen::Vector3d& p) const;
  // All heights from z.from_m to z.to_m above p.
  bool IsFree(const Eigen::Vector2d& p, Interval z) const;
  // Every point of the straight line from p to q.
  bool IsFreeBetween(const Eigen::Vector3d& p, const Eigen::Vector3d& q) const;

  // To the nearest footprint that is blocked at height z: 0 inside, infinite where there is none.
  double HorizontalDistance(const Eigen::Vector2d& p, double z) const;

  const Prisms& footprints() const { return footprints_; }
  const Prisms& no_fly() const { return no_fly_; }
  const Site& site() const { return *site_; }

 private:
  const Site* site_;
  Prisms footprints_;
  Prisms no_fly_;
  double radius_m_ = 0;
};

// Calls fn(t0, t1) for pieces of the line from p to q (0..1, in order) over each of which the
// terrain is a polynomial of degree two, until it returns false; returns whether none did.
template <typename Fn>
bool ForTerrainPieces(const TerrainGrid& terrain, const Segment2d& line, const Fn& fn) {
  const Eigen::Vector2d from = (line.a - terrain.corner) / terrain.step_m;
  const Eigen::Vector2d d = (line.b - line.a) / terrain.step_m;
  const Eigen::Vector2i size(terrain.columns, terrain.rows);
  // The next grid line that the segment meets along each axis.
  Eigen::Vector2d next;
  for (int axis = 0; axis < 2; ++axis) {
    const double at = d[axis] > 0 ? std::floor(from[axis]) + 1 : std::ceil(from[axis]) - 1;
    next[axis] = d[axis] > 0 ? std::max(at, 0.0) : std::min(at, size[axis] - 1.0);
  }
  double t = 0;
  while (t < 1) {
    double end = 1;
    int crossed = -1;
    for (int axis = 0; axis < 2; ++axis) {
      if (d[axis] == 0 || next[axis] < 0 || next[axis] > size[axis] - 1) continue;
      const double at = (next[axis] - from[axis]) / d[axis];
      if (at < end) {
        end = at;
        crossed = axis;
      }
    }
    if (crossed >= 0) next[crossed] += d[crossed] > 0 ? 1 : -1;
    end = std::max(end, t);
    if (end > t && !fn(t, end)) return false;
    t = end;
    if (crossed < 0) break;
  }
  return true;
}

}  // namespace stucco::plan
