// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/thin_out.h"

#include <algorithm>
#include <optional>
#include <queue>
#include <span>

#include "survey/error.h"

namespace stucco::plan {
namespace {

constexpr int kFewestHovers = 3;
// Sums that differ by rounding only must not decide.
constexpr double kRounding = 1e-9;

struct Candidate {
  double redundancy;
  uint32_t hover;
  size_t age;  // number of removals when it was computed
  bool operator<(const Candidate& other) const {
    return redundancy != other.redundancy ? redundancy < other.redundancy : hover > other.hover;
  }
};

// Nothing when it has to stay.
std::optional<double> RedundancyOf(const ViewGraph& graph,
                                   std::span<const Requirement> requirements, double tau_r,
                                   uint32_t hover, std::span<const double> shares) {
  double out = 0;
  const std::span<const Sighting> sightings = graph.sightings(hover);
  for (size_t i = 0; i < sightings.size(); ++i) {
    SampleState state = graph.state(sightings[i].sample);
    if (state.reconstructability > tau_r) {
      out += shares[i] * (1 - tau_r / state.reconstructability);
    }
    state.reconstructability = state.reconstructability * (1 + kRounding) - shares[i];
    --state.hovers;
    state.nadirs -= sightings[i].nadir;
    if (!requirements[sightings[i].sample].MetBy(state)) return std::nullopt;
  }
  return out;
}

}  // namespace

std::vector<Requirement> RequirementsOf(const ViewGraph& graph,
                                        std::span<const SurfaceSample> samples, double tau_r) {
  std::vector<Requirement> out(samples.size());
  for (uint32_t s = 0; s < samples.size(); ++s) {
    const SampleState& state = graph.state(s);
    const double h = state.reconstructability;
    out[s].reconstructability = h >= tau_r ? tau_r : 0.5 * h;
    out[s].hovers = std::min(kFewestHovers, state.hovers);
    out[s].nadirs = samples[s].kind == SurfaceKind::kWall ? 0 : std::min(1, state.nadirs);
  }
  return out;
}

size_t RemoveRedundant(ViewGraph& graph, std::span<const Requirement> requirements, double tau_r,
                       uint32_t count, Progress& progress) {
  std::priority_queue<Candidate> queue;
  const auto push = [&](uint32_t hover, size_t age) {
    const auto redundancy =
        RedundancyOf(graph, requirements, tau_r, hover, graph.Shares(hover));
    if (redundancy) queue.push({*redundancy, hover, age});
    return redundancy.has_value();
  };
  for (uint32_t hover = 0; hover < count; ++hover) {
    if (!graph.removed(hover)) push(hover, 0);
  }
  size_t gone = 0;
  progress.Begin("planar views: thinning out", queue.size());
  while (!queue.empty()) {
    const Candidate top = queue.top();
    queue.pop();
    if (progress.Cancelled()) throw Error(ErrorKind::kInterrupted, "interrupted");
    if (top.age == gone) {
      graph.Remove(top.hover, graph.Shares(top.hover));
      ++gone;
      progress.Advance();
    } else if (!push(top.hover, gone)) {
      progress.Advance();
    }
  }
  return gone;
}

}  // namespace stucco::plan
