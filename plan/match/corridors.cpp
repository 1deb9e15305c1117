// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/corridors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>
#include <utility>

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

// Outlines are points this near to each other, at most one in a square so large: gaps are known to
// about as much.
constexpr double kStep_m = 5;

std::vector<Vector2d> PointsOf(const Site& site) {
  std::vector<Vector2d> points;
  std::set<std::pair<long, long>> taken;
  const auto add = [&](const Vector2d& point) {
    const Vector2d cell = point / kStep_m;
    if (taken.emplace(std::lround(cell.x()), std::lround(cell.y())).second) points.push_back(point);
  };
  for (const Footprint& footprint : site.footprints) {
    if (!footprint.in_area || footprint.is_obstacle || footprint.outline.rings.empty()) continue;
    const Ring& ring = footprint.outline.rings.front();
    for (size_t i = 0; i < ring.size(); ++i) {
      const Vector2d edge = ring[(i + 1) % ring.size()] - ring[i];
      const double parts = std::max(1.0, std::ceil(edge.norm() / kStep_m));
      for (double k = 0; k < parts; ++k) add(ring[i] + k / parts * edge);
    }
  }
  return points;
}

}  // namespace

std::vector<Segment2d> CorridorsOf(const Site& site, double gap_m) {
  struct Open {
    Vector2d point;
    Vector2d nearest = Vector2d::Zero();  // in the tree
    double distance = std::numeric_limits<double>::infinity();
  };
  std::vector<Open> open;
  for (const Vector2d& point : PointsOf(site)) open.push_back({.point = point});
  std::vector<Segment2d> corridors;
  while (!open.empty()) {
    const auto next = std::ranges::min_element(open, {}, &Open::distance);
    if (next->distance > gap_m && next->distance <= kLongestCorridor_m) {
      corridors.push_back({next->nearest, next->point});
    }
    const Vector2d added = next->point;
    *next = open.back();
    open.pop_back();
    for (Open& other : open) {
      const double distance = (other.point - added).norm();
      if (distance >= other.distance) continue;
      other.distance = distance;
      other.nearest = added;
    }
  }
  return corridors;
}

}  // namespace stucco::plan
