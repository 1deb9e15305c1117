// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/planar/view_graph.h"
#include "survey/stage.h"

namespace stucco::plan {

// What thinning out must leave to every sample.
struct Requirement {
  double reconstructability = 0;
  int hovers = 0;
  int nadirs = 0;  // photos straight down, of roofs and ground

  bool MetBy(const SampleState& state) const {
    return state.reconstructability >= reconstructability && state.hovers >= hovers &&
           state.nadirs >= nadirs;
  }
};

// From what the full set of hovers gives. A sample that reaches `tau_r` may fall to it; one that
// does not may lose nothing. A sample keeps three hovers that see it, or as many as it has, and on
// roofs and ground a photo straight down.
std::vector<Requirement> RequirementsOf(const ViewGraph& graph,
                                        std::span<const SurfaceSample> samples, double tau_r);

// Takes hovers with the numbers 0 to `count` - 1 out of the graph, always (nearly) the most
// redundant one, until none can go without a sample losing what it requires. The redundancy of a
// hover is how many times what it requires its worst-off sample has left without the hover. The
// paper sums what samples have above tau_r; that takes the hovers that contribute most first and
// leaves a quarter more of them. Redundancy only ever shrinks while hovers go, so a lazy queue
// suffices. Returns how many went. Throws Error (kInterrupted).
size_t RemoveRedundant(ViewGraph& graph, std::span<const Requirement> requirements, uint32_t count,
                       Progress& progress);

}  // namespace stucco::plan
