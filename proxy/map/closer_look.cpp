// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/closer_look.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Spatial_sort_traits_adapter_2.h>
#include <CGAL/hilbert_sort.h>
#include <CGAL/property_map.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numeric>
#include <set>
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

// Which buildings nearly touch each.
std::vector<std::vector<size_t>> TouchingEach(std::span<const MapBuilding> buildings) {
  std::vector<Eigen::AlignedBox2d> bounds;
  bounds.reserve(buildings.size());
  for (const MapBuilding& building : buildings) bounds.push_back(BoundsOf(building, kApart_m / 2));
  std::vector<size_t> by_left(buildings.size());
  std::iota(by_left.begin(), by_left.end(), size_t{0});
  std::ranges::stable_sort(by_left, {}, [&](size_t b) { return bounds[b].min().x(); });
  std::vector<std::vector<size_t>> touching(buildings.size());
  for (size_t i = 0; i < by_left.size(); ++i) {
    const size_t a = by_left[i];
    for (size_t j = i + 1; j < by_left.size(); ++j) {
      const size_t b = by_left[j];
      if (bounds[b].min().x() > bounds[a].max().x()) break;
      if (!bounds[a].intersects(bounds[b]) || !NearlyTouch(buildings[a], buildings[b])) continue;
      touching[a].push_back(b);
      touching[b].push_back(a);
    }
  }
  return touching;
}

// Buildings that nearly touch, directly or through others.
std::vector<std::vector<size_t>> RowsOf(const std::vector<std::vector<size_t>>& touching) {
  DisjointSets sets(touching.size());
  for (size_t a = 0; a < touching.size(); ++a) {
    for (const size_t b : touching[a]) sets.Join(static_cast<int>(a), static_cast<int>(b));
  }
  std::map<int, std::vector<size_t>> members;
  for (size_t b = 0; b < touching.size(); ++b) {
    members[sets.Find(static_cast<int>(b))].push_back(b);
  }
  std::vector<std::vector<size_t>> rows;
  rows.reserve(members.size());
  for (auto& [first, row] : members) rows.push_back(std::move(row));
  return rows;
}

using SortKernel = CGAL::Simple_cartesian<double>;

// Numbers of places such that near ones follow each other.
std::vector<size_t> AlongCurve(const std::vector<SortKernel::Point_2>& places) {
  std::vector<size_t> order(places.size());
  std::iota(order.begin(), order.end(), size_t{0});
  const auto place_of = CGAL::make_property_map(places);
  CGAL::hilbert_sort(order.begin(), order.end(),
                     CGAL::Spatial_sort_traits_adapter_2<SortKernel, decltype(place_of)>(place_of),
                     CGAL::Hilbert_sort_middle_policy());
  return order;
}

// What comes together in sets.
class SetMaker {
 public:
  SetMaker(const UprightSurvey& survey, std::span<const MapBuilding> buildings)
      : survey_(survey),
        buildings_(buildings),
        touching_(TouchingEach(buildings)),
        finer_(survey.samples.cell / FineCell(survey.tolerances)),
        set_of_sample_(survey.samples.size(), kNone) {}

  std::vector<SetOfBuildings> Make(double most) {
    const auto rows = RowsOf(touching_);
    for (const size_t r : AlongCurve(MiddlesOf(rows))) {
      if (NewSamples(SamplesAround(rows[r])) <= most) {
        Add(rows[r], most);
        continue;
      }
      EndSet();
      std::vector<std::vector<size_t>> single;
      for (const size_t b : rows[r]) single.push_back({b});
      constexpr double kOwn = 0.6;  // the others are for what stands beside them
      for (const size_t i : AlongCurve(MiddlesOf(single))) Add(single[i], kOwn * most);
      EndSet();
    }
    EndSet();
    return std::move(sets_);
  }

 private:
  static constexpr size_t kNone = std::numeric_limits<size_t>::max();

  std::vector<SortKernel::Point_2> MiddlesOf(const std::vector<std::vector<size_t>>& rows) const {
    std::vector<SortKernel::Point_2> middles;
    for (const auto& row : rows) {
      Eigen::AlignedBox2d box;
      for (const size_t b : row) box.extend(BoundsOf(buildings_[b], 0));
      middles.emplace_back(box.center().x(), box.center().y());
    }
    return middles;
  }

  // Each once.
  std::vector<int> SamplesAround(const std::vector<size_t>& row) const {
    std::vector<int> samples;
    for (const size_t b : row) {
      const std::vector<int> around = survey_.bins.In(BoundsOf(buildings_[b], kAround_m));
      samples.insert(samples.end(), around.begin(), around.end());
    }
    std::ranges::sort(samples);
    samples.erase(std::unique(samples.begin(), samples.end()), samples.end());
    return samples;
  }

  // As many as there will be in the set that is open, once they are thinned finely.
  double NewSamples(const std::vector<int>& samples) const {
    double fine = 0;  // they lie on surfaces, and there are no more than points
    for (const int i : samples) {
      if (set_of_sample_[i] == sets_.size()) continue;
      fine += std::min(finer_ * finer_, static_cast<double>(survey_.samples.weights[i]));
    }
    return fine;
  }

  void Add(const std::vector<size_t>& row, double most) {
    const std::vector<int> samples = SamplesAround(row);
    if (expected_ + NewSamples(samples) > most) EndSet();
    expected_ += NewSamples(samples);
    for (const int i : samples) set_of_sample_[i] = sets_.size();
    open_.insert(open_.end(), row.begin(), row.end());
  }

  void EndSet() {
    if (open_.empty()) return;
    std::ranges::sort(open_);
    std::set<size_t> beside;
    for (const size_t b : open_) beside.insert(touching_[b].begin(), touching_[b].end());
    for (const size_t b : open_) beside.erase(b);
    sets_.push_back(
        {.members = std::exchange(open_, {}), .beside = {beside.begin(), beside.end()}});
    expected_ = 0;
  }

  const UprightSurvey& survey_;
  std::span<const MapBuilding> buildings_;
  std::vector<std::vector<size_t>> touching_;
  double finer_;  // than the survey's samples
  std::vector<SetOfBuildings> sets_;
  std::vector<size_t> open_;           // members of the set that comes next
  double expected_ = 0;                // samples of it
  std::vector<size_t> set_of_sample_;  // the last one that it was in
};

}  // namespace

bool NeedsCloserLook(const PlanarScene& scene) {
  constexpr double kWorthIt = 1.2;
  return scene.samples.cell > kWorthIt * FineCell(scene.tolerances);
}

std::vector<SetOfBuildings> SetsOfBuildings(const UprightSurvey& survey,
                                            std::span<const MapBuilding> buildings,
                                            int max_points) {
  return SetMaker(survey, buildings).Make(max_points);
}

UprightSurvey CloserLook(const PlanarScene& scene, const CloudOfPhotos& cloud,
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
  const PointStream blocks = cloud.blocks.Near(box);
  const PointStream near{blocks.count, [&](const PointVisit& visit) {
                           blocks.for_each([&](const CloudPoint& point) {
                             if (wanted(point.position)) visit(point);
                           });
                         }};
  Samples samples =
      ThinInside(box, near, cloud.photos, options.max_points, FineCell(scene.tolerances));
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
