// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/thin_out.h"

#include <algorithm>
#include <limits>
#include <queue>
#include <span>

#include "survey/error.h"

namespace stucco::plan {
namespace {

constexpr int kFewestHovers = 3;
// Sums that differ by rounding only must not decide.
constexpr double kRounding = 1e-9;
// A hover goes when no other can be more redundant by more than this share: asking all the others
// for the last digit takes several times as long and leaves as many.
constexpr double kNearlyBest = 0.1;

struct Candidate {
  double redundancy;  // at most so much
  uint32_t hover;
  bool operator<(const Candidate& other) const {
    return redundancy != other.redundancy ? redundancy < other.redundancy : hover > other.hover;
  }
};

class Thinning {
 public:
  Thinning(ViewGraph& graph, std::span<const Requirement> requirements, uint32_t count)
      : graph_(graph), requirements_(requirements), weakest_(count) {}

  // Without asking for shares: nothing can be more redundant than this.
  double Bound(uint32_t hover);
  // By the sample that was the weakest when last asked.
  double BoundByWeakest(uint32_t hover) const;
  double Redundancy(uint32_t hover, std::span<const double> shares);

 private:
  // How many times what it requires the sample has left.
  double Left(const Sighting& sighting, double share) const;

  ViewGraph& graph_;
  std::span<const Requirement> requirements_;
  std::vector<uint32_t> weakest_;  // of a hover's sightings, by hover
};

double Thinning::Left(const Sighting& sighting, double share) const {
  const Requirement& required = requirements_[sighting.sample];
  const SampleState& state = graph_.state(sighting.sample);
  if (state.hovers - 1 < required.hovers || state.nadirs - sighting.nadir < required.nadirs) {
    return 0;
  }
  if (!(required.reconstructability > 0)) return std::numeric_limits<double>::infinity();
  return (state.reconstructability * (1 + kRounding) - share) / required.reconstructability;
}

double Thinning::Bound(uint32_t hover) {
  double least = std::numeric_limits<double>::infinity();
  const std::span<const Sighting> sightings = graph_.sightings(hover);
  for (uint32_t i = 0; i < sightings.size(); ++i) {
    const double left = Left(sightings[i], 0);
    if (left >= least) continue;
    least = left;
    weakest_[hover] = i;
  }
  return least;
}

double Thinning::BoundByWeakest(uint32_t hover) const {
  const std::span<const Sighting> sightings = graph_.sightings(hover);
  if (sightings.empty()) return std::numeric_limits<double>::infinity();
  return Left(sightings[weakest_[hover]], graph_.Share(hover, weakest_[hover]));
}

double Thinning::Redundancy(uint32_t hover, std::span<const double> shares) {
  double least = std::numeric_limits<double>::infinity();
  const std::span<const Sighting> sightings = graph_.sightings(hover);
  for (uint32_t i = 0; i < sightings.size(); ++i) {
    const double left = Left(sightings[i], shares[i]);
    if (left >= least) continue;
    least = left;
    weakest_[hover] = i;
  }
  return least;
}

}  // namespace

std::vector<Requirement> RequirementsOf(const ViewGraph& graph,
                                        std::span<const SurfaceSample> samples, double tau_r) {
  std::vector<Requirement> out(samples.size());
  for (uint32_t s = 0; s < samples.size(); ++s) {
    const SampleState& state = graph.state(s);
    out[s].reconstructability = std::min(tau_r, state.reconstructability);
    out[s].hovers = std::min(kFewestHovers, state.hovers);
    out[s].nadirs = samples[s].kind == SurfaceKind::kWall ? 0 : std::min(1, state.nadirs);
  }
  return out;
}

size_t RemoveRedundant(ViewGraph& graph, std::span<const Requirement> requirements, uint32_t count,
                       Progress& progress) {
  Thinning thinning(graph, requirements, count);
  std::priority_queue<Candidate> queue;
  for (uint32_t hover = 0; hover < count; ++hover) {
    if (!graph.removed(hover)) queue.push({thinning.Bound(hover), hover});
  }
  size_t gone = 0;
  progress.Begin("planar views: thinning out", queue.size());
  // Puts it back if it is not good enough.
  const auto falls_back = [&](uint32_t hover, double redundancy) {
    if (!(redundancy >= 1)) {
      progress.Advance();  // it stays for good
      return true;
    }
    if (queue.empty() || redundancy >= (1 - kNearlyBest) * queue.top().redundancy) return false;
    queue.push({redundancy, hover});
    return true;
  };
  while (!queue.empty()) {
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    const uint32_t hover = queue.top().hover;
    queue.pop();
    if (falls_back(hover, thinning.BoundByWeakest(hover))) continue;
    const std::vector<double> shares = graph.Shares(hover);
    if (falls_back(hover, thinning.Redundancy(hover, shares))) continue;
    graph.Remove(hover, shares);
    ++gone;
    progress.Advance();
  }
  return gone;
}

}  // namespace stucco::plan
