// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/shift_onto_map.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <utility>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr size_t kMostWallPoints = 20000;
constexpr size_t kMostRoofPoints = 5000;
constexpr double kMostOffset_m = 6;
constexpr double kStep_m = 0.5;
constexpr double kOffWallEnds_m = 1;  // what lies nearer may belong to ground or roof
constexpr double kOnWall_m = 0.4;
constexpr double kHigh_m = 3;  // above the foot of a building: no car, hedge or fence
constexpr size_t kLeastOnWalls = 100;
constexpr int kRefineRounds = 5;

// A point near the plane of a wall.
struct NearWall {
  Vector2d normal = Vector2d::UnitX();
  double distance_m = 0;  // before the wall
};

// A point that may lie in some footprints after a shift.
struct NearRoof {
  Vector2d place = Vector2d::Zero();
  std::vector<const PlannedFootprint*> footprints;
};

std::vector<NearWall> PointsNearWalls(std::span<const Vector3d> points,
                                      const std::vector<PlannedFacade>& walls) {
  std::vector<NearWall> near;
  const size_t step = points.size() / kMostWallPoints + 1;
  for (size_t i = 0; i < points.size(); i += step) {
    for (const PlannedFacade& wall : walls) {
      const auto distance = BeforeWall(wall, points[i]);
      if (distance && std::abs(*distance) <= kMostOffset_m) {
        near.push_back({wall.outwards(), *distance});
      }
    }
  }
  return near;
}

// Boxes of the footprints, wider by what points may be shifted.
std::vector<Eigen::AlignedBox2d> WideBoxes(const std::vector<PlannedFootprint>& footprints) {
  std::vector<Eigen::AlignedBox2d> boxes;
  boxes.reserve(footprints.size());
  for (const PlannedFootprint& footprint : footprints) {
    Eigen::AlignedBox2d box;
    for (const Ring& ring : footprint.rings_m) {
      for (const Vector2d& corner : ring) box.extend(corner);
    }
    if (!box.isEmpty()) {
      box.min().array() -= kMostOffset_m;
      box.max().array() += kMostOffset_m;
    }
    boxes.push_back(box);
  }
  return boxes;
}

std::vector<NearRoof> PointsNearRoofs(std::span<const Vector3d> points,
                                      const std::vector<PlannedFootprint>& footprints) {
  const std::vector<Eigen::AlignedBox2d> boxes = WideBoxes(footprints);
  std::vector<NearRoof> near;
  const size_t step = points.size() / kMostRoofPoints + 1;
  for (size_t i = 0; i < points.size(); i += step) {
    NearRoof point{points[i].head<2>(), {}};
    for (size_t f = 0; f < footprints.size(); ++f) {
      if (footprints[f].is_obstacle || !boxes[f].contains(point.place)) continue;
      if (points[i].z() < footprints[f].z_m.from_m + kHigh_m) continue;
      point.footprints.push_back(&footprints[f]);
    }
    if (!point.footprints.empty()) near.push_back(std::move(point));
  }
  return near;
}

bool IsInside(const PlannedFootprint& footprint, const Vector2d& place) {
  return std::ranges::count_if(footprint.rings_m,
                               [&](const Ring& ring) { return Contains(ring, place); }) %
             2 ==
         1;
}

double NumInFootprints(const std::vector<NearRoof>& points, const Vector2d& shift) {
  return static_cast<double>(std::ranges::count_if(points, [&](const NearRoof& point) {
    const Vector2d place = point.place + shift;
    return std::ranges::any_of(point.footprints, [&](const PlannedFootprint* footprint) {
      return IsInside(*footprint, place);
    });
  }));
}

double NumOnWalls(const std::vector<NearWall>& points, const Vector2d& shift) {
  return static_cast<double>(std::ranges::count_if(points, [&](const NearWall& point) {
    return std::abs(point.distance_m + point.normal.dot(shift)) < kOnWall_m;
  }));
}

// Least squares over the points that are on walls after the shift.
Vector2d Refined(const std::vector<NearWall>& points, Vector2d shift) {
  for (int round = 0; round < kRefineRounds; ++round) {
    Eigen::Matrix2d normals = 1e-3 * Eigen::Matrix2d::Identity();
    Vector2d right = Vector2d::Zero();
    for (const NearWall& point : points) {
      const double off = point.distance_m + point.normal.dot(shift);
      if (std::abs(off) > kOnWall_m) continue;
      normals += point.normal * point.normal.transpose();
      right -= off * point.normal;
    }
    shift += normals.ldlt().solve(right);
  }
  return shift;
}

// Zero first: what is no better than it does not move the points.
std::vector<Vector2d> ShiftsToTry() {
  std::vector<Vector2d> shifts = {Vector2d::Zero()};
  const int steps = static_cast<int>(kMostOffset_m / kStep_m);
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) shifts.emplace_back(kStep_m * Vector2d(x, y));
  }
  return shifts;
}

}  // namespace

std::optional<double> BeforeWall(const PlannedFacade& wall, const Vector3d& point) {
  if (point.z() < wall.z_m.from_m + kOffWallEnds_m || point.z() > wall.z_m.to_m - kOffWallEnds_m) {
    return std::nullopt;
  }
  const Vector2d from = point.head<2>() - wall.a_m;
  const double along = from.dot(wall.along());
  if (along < 0 || along > wall.length_m()) return std::nullopt;
  return from.dot(wall.outwards());
}

Vector2d ShiftOntoMap(std::span<const Vector3d> points, const SiteMap& map) {
  const std::vector<NearWall> near_walls = PointsNearWalls(points, map.walls);
  const std::vector<NearRoof> near_roofs = PointsNearRoofs(points, map.footprints);
  const std::vector<Vector2d> shifts = ShiftsToTry();
  std::vector<Vector2d> counts;  // on walls, in footprints
  Vector2d most = Vector2d::Ones();
  for (const Vector2d& shift : shifts) {
    counts.emplace_back(NumOnWalls(near_walls, shift), NumInFootprints(near_roofs, shift));
    most = most.cwiseMax(counts.back());
  }
  const auto share = [&](const Vector2d& count) { return count.cwiseQuotient(most).sum(); };
  const auto best =
      static_cast<size_t>(std::ranges::max_element(counts, std::less<>(), share) - counts.begin());
  if (counts[best].x() < kLeastOnWalls) return Vector2d::Zero();
  return Refined(near_walls, shifts[best]);
}

}  // namespace stucco
