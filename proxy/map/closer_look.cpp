// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/closer_look.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/normals.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

constexpr double kAround_m = 5;  // of its bounds: the ground at its foot, a map that is off

// What samples may lie apart for the details that are wanted of the survey.
double FineCell(const Tolerances& tolerances) {
  return tolerances.level_of_detail / tolerances.coarseness / kSamplesPerDetail;
}

// The ground plan around some buildings, by squares of a metre.
class Surroundings {
 public:
  explicit Surroundings(std::span<const MapBuilding> buildings) {
    for (const MapBuilding& building : buildings) box_.extend(BoundsOf(building, kAround_m));
    width_ = static_cast<int>(box_.sizes().x()) + 1;
    wanted_.assign(static_cast<size_t>(width_) * (static_cast<size_t>(box_.sizes().y()) + 1),
                   false);
    for (const MapBuilding& building : buildings) {
      const Eigen::AlignedBox2d bounds = BoundsOf(building, kAround_m);
      const Eigen::Array2i low = (bounds.min() - box_.min()).array().cast<int>();
      const Eigen::Array2i high = (bounds.max() - box_.min()).array().cast<int>();
      for (int y = low.y(); y <= high.y(); ++y) {
        for (int x = low.x(); x <= high.x(); ++x) wanted_[IndexOf(x, y)] = true;
      }
    }
  }

  bool Contains(const Eigen::Vector2d& p) const {
    if (!box_.contains(p)) return false;
    const Eigen::Array2i at = (p - box_.min()).array().cast<int>();
    return wanted_[IndexOf(at.x(), at.y())];
  }

 private:
  size_t IndexOf(int x, int y) const {
    return static_cast<size_t>(y) * static_cast<size_t>(width_) + static_cast<size_t>(x);
  }

  Eigen::AlignedBox2d box_;
  int width_ = 0;
  std::vector<bool> wanted_;
};

constexpr double kApart_m = 1;

// Whether two outlines come that near to each other. A house in the middle of another's yard need
// not.
bool NearlyTouch(const MapBuilding& a, const MapBuilding& b) {
  const auto edges_of = [](const MapBuilding& building) {
    std::vector<Segment2d> edges;
    for (const Polygon& part : building.parts) {
      for (const Ring& ring : part.rings) {
        for (size_t i = 0; i < ring.size(); ++i) edges.push_back(EdgeOf(ring, i));
      }
    }
    return edges;
  };
  const std::vector<Segment2d> of_b = edges_of(b);
  return std::ranges::any_of(edges_of(a), [&](const Segment2d& edge) {
    return std::ranges::any_of(of_b, [&](const Segment2d& other) {
      return SquaredDistance(edge, other) < kApart_m * kApart_m;
    });
  });
}

// Buildings that nearly touch, as sets, each by its first building.
std::map<size_t, std::vector<size_t>> Neighbours(std::span<const MapBuilding> buildings) {
  std::vector<Eigen::AlignedBox2d> bounds;
  for (const MapBuilding& building : buildings) bounds.push_back(BoundsOf(building, kApart_m / 2));
  DisjointSets sets(buildings.size());
  for (size_t a = 0; a < bounds.size(); ++a) {
    for (size_t b = a + 1; b < bounds.size(); ++b) {
      if (!bounds[a].intersects(bounds[b]) || sets.Find(a) == sets.Find(b)) continue;
      if (NearlyTouch(buildings[a], buildings[b])) sets.Join(a, b);
    }
  }
  std::map<size_t, std::vector<size_t>> result;
  for (size_t b = 0; b < buildings.size(); ++b) result[sets.Find(b)].push_back(b);
  return result;
}

}  // namespace

bool NeedsCloserLook(const PlanarScene& scene) {
  constexpr double kWorthIt = 1.2;
  return scene.samples.cell > kWorthIt * FineCell(scene.tolerances);
}

std::vector<std::vector<size_t>> SetsOfBuildings(const UprightSurvey& survey,
                                                 std::span<const MapBuilding> buildings,
                                                 int max_points) {
  const double finer = survey.samples.cell / FineCell(survey.tolerances);
  std::vector<std::vector<size_t>> result;
  double expected = 0;  // samples of the last set
  for (const auto& [first, members] : Neighbours(buildings)) {
    double samples = 0;  // they lie on surfaces
    for (const size_t b : members) {
      const size_t coarse = survey.bins.In(BoundsOf(buildings[b], kAround_m)).size();
      samples += static_cast<double>(coarse) * finer * finer;
    }
    if (result.empty() || expected + samples > max_points) {
      result.emplace_back();
      expected = 0;
    }
    expected += samples;
    result.back().insert(result.back().end(), members.begin(), members.end());
  }
  return result;
}

UprightSurvey CloserLook(const PlanarScene& scene, const ProxyInput& input,
                         std::span<const MapBuilding> buildings, const ProxyOptions& options,
                         int threads) {
  const Surroundings surroundings(buildings);
  const Eigen::Matrix<double, 2, 3> plan_from_world = UprightFromWorld(scene.up).topRows<2>();
  const auto wanted = [&](const Eigen::Vector3d& p) {
    return surroundings.Contains(plan_from_world * p);
  };
  // Heights come from what the survey has already; strays above and below stay out.
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& p : scene.samples.positions) {
    if (wanted(p)) box.extend(p);
  }
  if (box.isEmpty()) return UprightSurveyOf(Samples{}, scene.tolerances, scene.up);
  box = {box.min().array() - kAround_m, box.max().array() + kAround_m};
  const PointStream near{input.cloud.count,
                         [&](const std::function<void(const CloudPoint&)>& visit) {
                           input.cloud.for_each([&](const CloudPoint& point) {
                             if (wanted(point.position)) visit(point);
                           });
                         }};
  Samples samples =
      ThinInside(box, near, input.photos, options.max_points, FineCell(scene.tolerances));
  constexpr size_t kFewest = 100;
  if (samples.size() < kFewest) {
    return UprightSurveyOf(std::move(samples), scene.tolerances, scene.up);
  }
  const Tolerances tolerances = DeriveTolerances(MeasureScale(samples), true, options);
  const GridIndex index(samples.positions, tolerances.radius);
  SmoothNormals(samples, index, tolerances.radius, threads);
  return UprightSurveyOf(std::move(samples), tolerances, scene.up);
}

}  // namespace stucco
