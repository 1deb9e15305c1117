// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/normals.h"
#include "proxy/planes/densest.h"
#include "proxy/planes/find_planes.h"
#include "proxy/planes/regularise.h"

namespace stucco {
namespace {

constexpr double kRoofNormal = 0.26;   // 75 degrees of pitch: steeper is a wall
constexpr double kGroundNormal = 0.9;  // cosine: 26 degrees
constexpr double kOnWall_m = 0.4;      // what stands upright this near to the outline is its wall

// By cells of half a metre: where there is anything, and where the ground shows.
void MeasureCover(const Samples& upright, const std::vector<int>& inside, double ground,
                  RoofEvidence& evidence) {
  constexpr double kCell_m = 0.5;
  std::map<std::pair<int, int>, bool> bare;
  for (const int i : inside) {
    const Eigen::Vector3d& p = upright.positions[i];
    bare[{static_cast<int>(std::floor(p.x() / kCell_m)),
          static_cast<int>(std::floor(p.y() / kCell_m))}] |= p.z() < ground + kRaised_m;
  }
  for (const auto& [cell, is_bare] : bare) {
    evidence.seen_m2 += kCell_m * kCell_m;
    if (is_bare) evidence.bare_m2 += kCell_m * kCell_m;
  }
}

std::vector<Plane> Detect(const Samples& samples, const Tolerances& tolerances,
                          const ProxyOptions& options) {
  if (samples.size() < 12) return {};
  const GridIndex index(samples.positions, tolerances.radius);
  Samples smooth = samples;  // the normals are smooth already: only the agreement is asked for
  const auto agreement = SmoothNormals(smooth, index, tolerances.radius, 1);
  return FindPlanes(samples, index, agreement, tolerances, options);
}

// Share of a plane's samples within `width` of the outline.
double OnRim(const Plane& plane, const Samples& samples, const MapBuilding& building,
             double width) {
  const auto on_rim = std::ranges::count_if(plane.points, [&](int i) {
    return ToOutline(building, samples.positions[i].head<2>()) < width;
  });
  return static_cast<double>(on_rim) / static_cast<double>(plane.points.size());
}

// Gutters and parapets, and how the cloud rounds them off, are no roofs of their own.
bool IsRim(const Plane& plane, const Samples& samples, const MapBuilding& building, double width) {
  constexpr double kMost = 0.9;  // of its samples
  return OnRim(plane, samples, building, width) > kMost;
}

// What of a plane lies away from the outline.
struct Inside {
  double samples = 0;
  double points = 0;  // of the cloud, that its samples stand for
  double Density() const { return points / std::max(1.0, samples); }
};

Inside InsideOf(const Plane& plane, const Samples& samples, const MapBuilding& building,
                double width) {
  Inside inside;
  for (const int i : plane.points) {
    if (ToOutline(building, samples.positions[i].head<2>()) < width) continue;
    inside.points += samples.weights[i];
    ++inside.samples;
  }
  return inside;
}

// Parapets of a roof run along the outline above it. What else lies at their height, where hardly
// anything is seen, are strays, which a parapet's plane would make a roof of. Planes that are as
// dense inside as the roof are platforms.
void DropParapets(const Samples& samples, const MapBuilding& building, double width,
                  std::vector<Plane>& planes) {
  constexpr double kHighest_m = 1.2;
  constexpr double kParallel = 0.999;  // cosine
  constexpr double kMost = 0.5;        // of its samples
  constexpr double kSparse = 0.5;      // of the roof's density
  std::vector<Inside> insides;
  insides.reserve(planes.size());
  for (const Plane& plane : planes) insides.push_back(InsideOf(plane, samples, building, width));
  std::vector<Plane> kept;
  for (size_t p = 0; p < planes.size(); ++p) {
    bool has_roof = false;
    for (size_t r = 0; r < planes.size(); ++r) {
      const double above = planes[p].offset - planes[r].offset;
      has_roof |= planes[p].normal.dot(planes[r].normal) > kParallel && above > 0 &&
                  above < kHighest_m && insides[p].points < insides[r].points &&
                  insides[p].Density() < kSparse * insides[r].Density();
    }
    const bool parapet = has_roof && OnRim(planes[p], samples, building, width) > kMost;
    if (!parapet) kept.push_back(planes[p]);
  }
  planes = std::move(kept);
}

// Upright planes along the outline, without samples: they only give roofs their directions.
std::vector<Plane> WallDirections(const FittedBuilding& building) {
  std::vector<Plane> walls;
  for (const FittedEdge& edge : building.edges) {
    const Eigen::Vector2d along = edge.line.b - edge.line.a;
    Plane& wall = walls.emplace_back();
    wall.role = PlaneRole::kWall;
    wall.normal = Eigen::Vector3d(along.y(), -along.x(), 0).normalized();
    wall.offset = wall.normal.head<2>().dot(edge.line.a);
    wall.area = along.norm();
  }
  return walls;
}

// Gives a step the direction of a wall that it is nearly parallel to: what stands on a roof is
// small, so that its own direction is not known to a degree.
void TurnAlong(std::span<const Plane> walls, const Samples& samples, Plane& step) {
  constexpr double kNearly = 0.9976;  // cosine of four degrees
  double most = kNearly;
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();
  for (const Plane& wall : walls) {
    const double alike = wall.normal.dot(step.normal);
    if (std::abs(alike) <= most) continue;
    most = std::abs(alike);
    direction = std::copysign(1.0, alike) * wall.normal;
  }
  if (direction.isZero() || step.points.empty()) return;
  double offset = 0;
  for (const int i : step.points) offset += direction.dot(samples.positions[i]);
  step.normal = direction;
  step.offset = offset / static_cast<double>(step.points.size());
}

// Upright planes among the samples by their indices, along the walls where they nearly are.
std::vector<Plane> StepsAmong(const UprightSurvey& survey, const std::vector<int>& indices,
                              std::span<const Plane> walls, const ProxyOptions& options) {
  const Samples samples = SubsetOf(survey.samples, indices);
  std::vector<Plane> steps = Detect(samples, survey.tolerances, options);
  std::erase_if(steps, [](const Plane& plane) { return !LooksLikeWall(plane.normal); });
  for (Plane& step : steps) TurnAlong(walls, samples, step);
  return steps;
}

}  // namespace

Samples SubsetOf(const Samples& samples, const std::vector<int>& indices) {
  Samples subset;
  subset.cell = samples.cell;
  for (const int i : indices) {
    subset.positions.push_back(samples.positions[i]);
    subset.normals.push_back(samples.normals[i]);
    subset.weights.push_back(samples.weights[i]);
    subset.cameras.push_back(-1);
  }
  return subset;
}

RoofEvidence FindRoofPlanes(const UprightSurvey& survey, const FittedBuilding& building,
                            const WallTops& walls, const ProxyOptions& options) {
  const Samples& upright = survey.samples;
  const Tolerances& tolerances = survey.tolerances;
  RoofEvidence evidence;
  std::vector<int> inside, above, steps;  // `inside` of the rim
  for (const int i : survey.bins.In(BoundsOf(building.building, 0))) {
    const Eigen::Vector3d& p = upright.positions[i];
    if (DistanceTo(building.building, p.head<2>()) > 0) continue;
    const bool upright_thing = LooksLikeWall(upright.normals[i]);
    const bool on_rim = ToOutline(building.building, p.head<2>()) < kOnWall_m;
    if (upright_thing && on_rim) continue;
    if (!on_rim) inside.push_back(i);
    if (p.z() < building.ground + kRaised_m) {
      if (upright.normals[i].z() > kGroundNormal) evidence.open.emplace_back(p.head<2>());
      continue;
    }
    if (walls.IsBelow(p)) continue;
    if (upright_thing) {
      steps.push_back(i);
    } else if (upright.normals[i].z() > kRoofNormal) {
      above.push_back(i);
    }
  }
  MeasureCover(upright, inside, building.ground, evidence);
  evidence.samples = SubsetOf(upright, above);
  std::vector<Plane> planes = Detect(evidence.samples, tolerances, options);
  std::erase_if(planes, [&](const Plane& plane) {
    return IsRim(plane, evidence.samples, building.building, 2 * tolerances.level_of_detail);
  });
  const std::vector<Plane> directions = WallDirections(building);
  planes.insert(planes.end(), directions.begin(), directions.end());
  Regularise(evidence.samples, tolerances, Eigen::Vector3d::UnitZ(),
             {.vertical_tolerance_deg = options.vertical_tolerance_deg,
              .align_tolerance_deg = options.align_tolerance_deg},
             planes);
  std::erase_if(planes, [](const Plane& plane) {
    return plane.points.empty() || plane.normal.z() < kRoofNormal;
  });
  for (Plane& plane : planes) RefitToDensest(evidence.samples, kFlat_m, plane);
  DropParapets(evidence.samples, building.building, 2 * tolerances.level_of_detail, planes);
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.area > b.area; });
  evidence.planes = std::move(planes);
  evidence.steps = StepsAmong(survey, steps, directions, options);
  return evidence;
}

}  // namespace stucco
