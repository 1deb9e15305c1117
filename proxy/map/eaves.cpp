// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/eaves.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>
#include <set>

#include "survey/degree.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

constexpr double kNear_m = 1;  // samples of an eave lie this near to its edge

// Where a roof ends at an edge of the outline that it falls to.
struct Eave {
  size_t roof = 0;
  Eigen::Vector2d foot = Eigen::Vector2d::Zero();     // on the edge
  Eigen::Vector2d outward = Eigen::Vector2d::Zero();  // unit, across the edge
  double length = 0;  // of the edge, where the roof has samples along it
  double height = 0;
  double weight = 0;  // samples of the roof
};

// Metres of an edge along which the roof has samples, by steps of half a metre.
double SharedLength(const Segment2d& edge, const RoofEvidence& evidence, const Plane& plane) {
  constexpr double kStep_m = 0.5;
  const Eigen::Vector2d along = (edge.b - edge.a).normalized();
  const double length = (edge.b - edge.a).norm();
  std::set<int> steps;
  for (const int i : plane.points) {
    const Eigen::Vector2d from = evidence.samples.positions[i].head<2>() - edge.a;
    const double at = along.dot(from);
    if (at < 0 || at > length || std::abs(Cross(along, from)) > kNear_m) continue;
    steps.insert(static_cast<int>(at / kStep_m));
  }
  return std::min(length, kStep_m * static_cast<double>(steps.size()));
}

// The eave of a roof: of the edges that it falls to, the one it has most samples along.
std::optional<Eave> EaveOf(const FittedBuilding& building, const RoofEvidence& evidence,
                           const Plane& plane, const RoofPlane& roof) {
  constexpr double kLeastSlope = 0.05;
  constexpr double kSquare = 2 * kDegree;
  constexpr double kLeastLength_m = 1;
  if (roof.slope.norm() < kLeastSlope) return std::nullopt;
  const Eigen::Vector2d downhill = -roof.slope.normalized();
  Eave best;
  for (const FittedEdge& edge : building.edges) {
    const Eigen::Vector2d outward = OutwardsOf(edge.line);
    if (downhill.dot(outward) < std::cos(kSquare)) continue;
    const double length = SharedLength(edge.line, evidence, plane);
    if (length <= best.length) continue;
    best.foot = edge.line.a;
    best.outward = outward;
    best.length = length;
  }
  if (best.length < kLeastLength_m) return std::nullopt;
  best.weight = static_cast<double>(plane.points.size());
  return best;
}

// Turns the roof to fall squarely over its eave, around the middle of its samples, unless that
// moves one of them by more than `most`.
void Square(const Samples& samples, const Plane& plane, const Eave& eave, double most,
            RoofPlane& roof) {
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const int i : plane.points) middle += samples.positions[i].head<2>();
  middle /= static_cast<double>(plane.points.size());
  RoofPlane squared{.slope = -roof.slope.norm() * eave.outward};
  squared.height = roof.At(middle) - squared.slope.dot(middle);
  const bool stays = std::ranges::all_of(plane.points, [&](int i) {
    const Eigen::Vector2d p = samples.positions[i].head<2>();
    return std::abs(squared.At(p) - roof.At(p)) <= most;
  });
  if (stays) roof = squared;
}

}  // namespace

void LevelEaves(const FittedBuilding& building, const RoofEvidence& evidence,
                std::span<const int> planes, const Tolerances& tolerances,
                std::vector<RoofPlane>& roofs) {
  assert(roofs.size() >= planes.size());
  const double most = std::min(0.05, tolerances.epsilon);
  std::vector<Eave> eaves;
  for (size_t k = 0; k < planes.size(); ++k) {
    const Plane& plane = evidence.planes[planes[k]];
    auto eave = EaveOf(building, evidence, plane, roofs[k]);
    if (!eave) continue;
    Square(evidence.samples, plane, *eave, most, roofs[k]);
    eave->roof = k;
    eave->height = roofs[k].At(eave->foot);
    eaves.push_back(*eave);
  }
  std::ranges::stable_sort(eaves, {}, &Eave::height);
  for (size_t first = 0; first < eaves.size();) {
    size_t end = first;
    double sum = 0, weight = 0;
    for (; end < eaves.size() && eaves[end].height - eaves[first].height <= most; ++end) {
      sum += eaves[end].weight * eaves[end].height;
      weight += eaves[end].weight;
    }
    for (size_t e = first; e < end; ++e) {
      roofs[eaves[e].roof].height += sum / weight - eaves[e].height;
    }
    first = end;
  }
}

}  // namespace stucco
