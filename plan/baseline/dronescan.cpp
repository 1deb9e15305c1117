// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/baseline/dronescan.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <queue>

#include "plan/planar/reconstructability.h"
#include "plan/planar/view_graph.h"
#include "plan/space/obstacles.h"
#include "site/incidence.h"
#include "site/sightings.h"
#include "survey/error.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr double kDistanceOfDMin = 2;
constexpr double kOverlap = 0.8;
constexpr double kGroundReach = 2;  // in d_min
// A candidate that is not free turns up around its sample, towards the vertical, in these steps;
// then it rises, still over the same point.
constexpr double kTurn_rad = 5 * std::numbers::pi / 180;
constexpr double kRise_m = 1;

// Constants of the removal (Zhou et al. 2020 and its published code): the target in good pairs;
// what a view may not take from a sample below the target, from any sample, and leave to any.
constexpr double kTargetPairs = 10;
constexpr double kMattersBelowTarget = 0.05;
constexpr double kMattersAnyway = 0.35;
constexpr double kLeastLeft = 2;

Shot Facing(const Eigen::Vector3d& from, const Eigen::Vector3d& to) {
  const Eigen::Vector3d way = to - from;
  const double level = way.head<2>().norm();
  return {.yaw_rad = level > 1e-9 * way.norm() ? std::atan2(way.x(), way.y()) : 0,
          .pitch_rad = std::atan2(way.z(), level),
          .kind = ViewKind::kSurface,
          .targets = {}};
}

class Candidates {
 public:
  Candidates(const Site& site, const SurfaceView& view, double distance_m)
      : site_(site), view_(view), distance_m_(distance_m), obstacles_(site) {}

  // Nothing where no safe place sees the sample.
  std::optional<Hover> For(const SurfaceSample& sample) const;

 private:
  bool Serves(const Eigen::Vector3d& place, const SurfaceSample& sample) const;
  std::optional<Eigen::Vector3d> PlaceFor(const SurfaceSample& sample) const;

  const Site& site_;
  const SurfaceView& view_;
  double distance_m_;
  Obstacles obstacles_;
};

bool Candidates::Serves(const Eigen::Vector3d& place, const SurfaceSample& sample) const {
  const Eigen::Vector3d ray = place - sample.position;
  return ray.norm() <= view_.reach_m &&
         ray.dot(sample.normal) >= std::cos(kMaxIncidence_rad) * ray.norm() &&
         obstacles_.IsFree(place) && view_.model.Sees(place, sample.position);
}

std::optional<Eigen::Vector3d> Candidates::PlaceFor(const SurfaceSample& sample) const {
  const Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  for (double turn = 0; turn <= kMaxIncidence_rad + 1e-9; turn += kTurn_rad) {
    const Eigen::Vector3d direction =
        (std::cos(turn) * sample.normal + std::sin(turn) * up).normalized();
    const Eigen::Vector3d place = sample.position + distance_m_ * direction;
    if (Serves(place, sample)) return place;
    if (sample.normal.z() > 0.5) break;  // it looks up already
  }
  Eigen::Vector3d place = sample.position + distance_m_ * sample.normal;
  const double ceiling = site_.CeilingAt(place.head<2>());
  while (place.z() < ceiling) {
    place.z() = std::min(ceiling, place.z() + kRise_m);
    if (Serves(place, sample)) return place;
  }
  return std::nullopt;
}

std::optional<Hover> Candidates::For(const SurfaceSample& sample) const {
  const auto place = PlaceFor(sample);
  if (!place) return std::nullopt;
  return Hover{*place, {Facing(*place, sample.position)}};
}

std::vector<Hover> AllCandidates(const Site& site, const SurfaceView& view, double distance_m,
                                 int threads) {
  const Candidates candidates(site, view, distance_m);
  std::vector<std::optional<Hover>> found(view.samples.size());
  ParallelFor(found.size(), threads, [&](size_t i) { found[i] = candidates.For(view.samples[i]); });
  std::vector<Hover> out;
  for (auto& hover : found) {
    if (hover) out.push_back(std::move(*hover));
  }
  return out;
}

// Whether the view has to stay for this sample, where `share` of h is its own.
bool Matters(double h, double share, double target) {
  const double left = h - share;
  return (left < target && share > kMattersBelowTarget * h) || share > kMattersAnyway * h ||
         left < kLeastLeft;
}

class Removal {
 public:
  Removal(ViewGraph& graph, double good_pair)
      : graph_(graph), target_(kTargetPairs * good_pair), reachable_(graph.states().size()) {
    for (uint32_t s = 0; s < reachable_.size(); ++s) {
      reachable_[s] = graph.state(s).reconstructability > good_pair;
    }
  }

  // The least h of the samples of a view: the inverse of its importance. It only shrinks.
  double WorstSample(uint32_t view) const;
  // Takes the view out unless a sample needs it.
  void TryWithout(uint32_t view);

 private:
  ViewGraph& graph_;
  double target_;
  std::vector<uint8_t> reachable_;
};

double Removal::WorstSample(uint32_t view) const {
  double worst = std::numeric_limits<double>::infinity();
  for (const Sighting& sighting : graph_.sightings(view)) {
    if (!reachable_[sighting.sample]) continue;
    worst = std::min(worst, graph_.state(sighting.sample).reconstructability);
  }
  return worst;
}

void Removal::TryWithout(uint32_t view) {
  const std::vector<double> shares = graph_.Shares(view);
  const std::span<const Sighting> sightings = graph_.sightings(view);
  for (size_t i = 0; i < sightings.size(); ++i) {
    if (!reachable_[sightings[i].sample]) continue;
    if (Matters(graph_.state(sightings[i].sample).reconstructability, shares[i], target_)) return;
  }
  graph_.Remove(view, shares);
}

void RemoveRedundant(ViewGraph& graph, double good_pair, Progress& progress) {
  struct Next {
    double worst;
    uint32_t view;
    bool operator<(const Next& other) const {
      return worst != other.worst ? worst < other.worst : view > other.view;
    }
  };
  Removal removal(graph, good_pair);
  std::priority_queue<Next> queue;
  for (uint32_t v = 0; v < graph.size(); ++v) queue.push({removal.WorstSample(v), v});
  progress.Begin("views of the surface: thinning out", queue.size());
  while (!queue.empty()) {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    const uint32_t view = queue.top().view;
    queue.pop();
    const Next now{removal.WorstSample(view), view};
    if (!queue.empty() && now < queue.top()) {
      queue.push(now);
      continue;
    }
    removal.TryWithout(view);
    progress.Advance();
  }
}

}  // namespace

std::vector<Hover> DroneScanViews(const Site& site, const CameraPreset& camera,
                                  const DroneScanOptions& options, int threads,
                                  Progress& progress) {
  const double distance = options.view_distance_m > 0
                              ? options.view_distance_m
                              : std::min(kDistanceOfDMin * site.d_min_m, options.d_max_m);
  const double spacing = options.sample_spacing_m > 0 ? options.sample_spacing_m
                                                      : (1 - kOverlap) * camera.HeightAt(distance);
  const SurfaceView view(
      site, camera.Field(),
      SampleSurface(site, {.spacing_m = spacing, .ground_reach_m = kGroundReach * site.d_min_m}),
      options.d_max_m);
  const std::vector<Hover> candidates = AllCandidates(site, view, distance, threads);
  progress.Begin("views of the surface: what they see", 1);
  ViewGraph graph(view, options.d_max_m, threads, /*by_scale=*/false);
  graph.AddAll(candidates);
  progress.Advance();
  RemoveRedundant(graph, GoodPair(distance, options.d_max_m), progress);
  std::vector<Hover> out;
  for (uint32_t v = 0; v < graph.size(); ++v) {
    if (!graph.removed(v)) out.push_back(candidates[v]);
  }
  return out;
}

}  // namespace stucco::plan
