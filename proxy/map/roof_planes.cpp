// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_planes.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/normals.h"
#include "proxy/map/ground_around.h"
#include "proxy/map/parapets.h"
#include "proxy/planes/densest.h"
#include "proxy/planes/find_planes.h"
#include "proxy/planes/regularise.h"

namespace stucco {
namespace {

constexpr double kRoofNormal = 0.26;   // 75 degrees of pitch: steeper is a wall
constexpr double kGroundNormal = 0.9;  // cosine: 26 degrees
constexpr double kOnWall_m = 0.4;      // what stands upright this near to the outline is its wall

// Whether other buildings stand around nearly all of it: what lies next to it are their roofs.
bool IsEnclosed(const FittedBuilding& building) {
  constexpr double kNearlyAll = 0.75;
  constexpr double kAside_m = 0.1;
  double all = 0, party = 0;
  for (const FittedEdge& edge : building.edges) {
    const double length = (edge.line.b - edge.line.a).norm();
    const Eigen::Vector2d beside =
        (edge.line.a + edge.line.b) / 2 + kAside_m * OutwardsOf(edge.line);
    if (DistanceTo(building.building, beside) == 0) continue;  // between its own parts
    all += length;
    party += edge.party ? length : 0;
  }
  return party > kNearlyAll * all;
}

// What is no part of a building by its height: on a slope also what goes on as the ground does
// around it, where most of the footprint does.
class LowThings {
 public:
  LowThings(const UprightSurvey& survey, const FittedBuilding& building)
      : below_(building.ground + kRaised_m) {
    constexpr double kMostOfIt = 0.6;
    if (IsEnclosed(building)) return;
    const auto slope = SlopeAround(survey, building.building);
    if (!slope) return;
    size_t inside = 0, on_it = 0;
    for (const int i : survey.bins.In(BoundsOf(building.building, 0))) {
      const Eigen::Vector3d& p = survey.samples.positions[i];
      if (DistanceTo(building.building, p.head<2>()) > 0) continue;
      ++inside;
      on_it += slope->Shows(p);
    }
    if (static_cast<double>(on_it) > kMostOfIt * static_cast<double>(inside)) slope_ = slope;
  }

  bool Has(const Eigen::Vector3d& p) const {
    return p.z() < below_ || (slope_ && slope_->Shows(p));
  }

 private:
  double below_;
  std::optional<GroundSlope> slope_;
};

// By cells of half a metre: where there is anything, and where the ground shows.
void MeasureCover(const Samples& upright, const std::vector<int>& inside, const LowThings& low,
                  RoofEvidence& evidence) {
  constexpr double kCell_m = 0.5;
  std::map<std::pair<int, int>, bool> bare;
  for (const int i : inside) {
    const Eigen::Vector3d& p = upright.positions[i];
    bare[{static_cast<int>(std::floor(p.x() / kCell_m)),
          static_cast<int>(std::floor(p.y() / kCell_m))}] |= low.Has(p);
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

RoofStep StepOf(Plane plane, const Samples& samples) {
  RoofStep step{.plane = std::move(plane)};
  std::vector<double> along;
  for (const int i : step.plane.points) {
    const Eigen::Vector3d& p = samples.positions[i];
    along.push_back(step.plane.normal.x() * p.y() - step.plane.normal.y() * p.x());
  }
  const auto [from, to] = std::ranges::minmax(along);
  step.from = from;
  step.to = to;
  return step;
}

// Whether what looks this way has so much of the footprint before it that it lies in no loggia.
bool HasFootprintBefore(const MapBuilding& footprint, const Eigen::Vector3d& p,
                        const Eigen::Vector3d& normal) {
  constexpr double kDeepestLoggia_m = 2;
  return DistanceTo(footprint, (p + kDeepestLoggia_m * normal).head<2>()) == 0;
}

// Upright planes among the samples by their indices, along the walls where they nearly are; their
// points are places in `indices`.
std::vector<RoofStep> StepsAmong(const UprightSurvey& survey, const std::vector<int>& indices,
                                 std::span<const Plane> walls, const ProxyOptions& options) {
  const Samples samples = SubsetOf(survey.samples, indices);
  std::vector<RoofStep> steps;
  for (Plane& plane : Detect(samples, survey.tolerances, options)) {
    if (!LooksLikeWall(plane.normal) || plane.points.empty()) continue;
    TurnAlong(walls, samples, plane);
    steps.push_back(StepOf(std::move(plane), samples));
  }
  return steps;
}

// From where photos saw what of these steps lies in no loggia.
std::vector<SightLine> SightsOf(const std::vector<RoofStep>& steps, const std::vector<int>& indices,
                                const Samples& samples, const MapBuilding& footprint) {
  std::vector<SightLine> sights;
  for (const RoofStep* wall : MainWalls(steps)) {
    for (const int point : wall->plane.points) {
      const int i = indices[point];
      const Eigen::Vector3d& p = samples.positions[i];
      const Eigen::Vector3d* eye = samples.EyeOf(i);
      if (eye && HasFootprintBefore(footprint, p, wall->plane.normal)) sights.push_back({p, *eye});
    }
  }
  return sights;
}

}  // namespace

std::vector<const RoofStep*> MainWalls(const std::vector<RoofStep>& steps) {
  constexpr double kSameWay = 0.9;  // cosine
  constexpr double kBesideWall_m = 3;
  const auto is_of = [&](const RoofStep& step, const RoofStep& wall) {
    return wall.plane.area > step.plane.area &&
           wall.plane.normal.dot(step.plane.normal) > kSameWay &&
           std::abs(wall.plane.offset - step.plane.offset) < kBesideWall_m && wall.from < step.to &&
           step.from < wall.to;
  };
  std::vector<const RoofStep*> walls;
  for (const RoofStep& step : steps) {
    const bool of_other =
        std::ranges::any_of(steps, [&](const RoofStep& other) { return is_of(step, other); });
    if (!of_other) walls.push_back(&step);
  }
  return walls;
}

double EnoughSamples(double side, double spacing) {
  return 0.5 * std::pow(side / spacing, 2);
}

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
  const LowThings low(survey, building);
  RoofEvidence evidence;
  std::vector<int> inside, above, steps;  // `inside` of the rim
  for (const int i : survey.bins.In(BoundsOf(building.building, 0))) {
    const Eigen::Vector3d& p = upright.positions[i];
    if (DistanceTo(building.building, p.head<2>()) > 0) continue;
    const bool upright_thing = LooksLikeWall(upright.normals[i]);
    const bool on_rim = ToOutline(building.building, p.head<2>()) < kOnWall_m;
    if (upright_thing && on_rim) continue;
    if (!on_rim) inside.push_back(i);
    if (low.Has(p)) {
      if (upright.normals[i].z() > kGroundNormal) evidence.open.emplace_back(p.head<2>());
      continue;
    }
    const bool below = walls.IsBelow(p);
    if (upright_thing && (!below || HasFootprintBefore(building.building, p, upright.normals[i]))) {
      steps.push_back(i);
    } else if (!upright_thing && !below && upright.normals[i].z() > kRoofNormal) {
      above.push_back(i);
    }
  }
  MeasureCover(upright, inside, low, evidence);
  evidence.samples = SubsetOf(upright, above);
  std::vector<Plane> planes = Detect(evidence.samples, tolerances, options);
  DropRims(evidence.samples, building.building, 2 * tolerances.level_of_detail, planes);
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
  DropParapets(evidence.samples, building.building, tolerances, planes);
  std::stable_sort(planes.begin(), planes.end(),
                   [](const Plane& a, const Plane& b) { return a.area > b.area; });
  evidence.planes = std::move(planes);
  evidence.steps = StepsAmong(survey, steps, directions, options);
  evidence.sights = SightsOf(evidence.steps, steps, upright, building.building);
  return evidence;
}

}  // namespace stucco
