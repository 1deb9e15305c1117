// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/planar/thin_out.h"
#include "plan/space/obstacles.h"
#include "survey/stage.h"

namespace stucco::plan {

// How hovers move.
struct MoveSetting {
  const Obstacles& obstacles;
  std::span<const Requirement> requirements;
  double step_m = 0;                                // tau_p
  Eigen::Vector2d axis = Eigen::Vector2d::UnitX();  // of the steps
  double tau_r = 0;
  int threads = 1;
};

// One round of moves: each hover with a number below `hovers.size()` that is in the graph looks at
// its eight neighbours at one step, and goes to one that dominates its place in the objective
// vector Y of the paper: (-Q of roofs and ground, -Q_r, number of hovers), with
//   Q   = Q_u + Q_c of the photos straight down, over samples: seen / sightings + seen / all,
//   Q_r = sum over samples of h / (h + tau_r), so that what a sample has in plenty counts little.
// The number of hovers is the same for all places. Where several places dominate, the one with the
// largest Q_r is taken. No sample loses what it requires. Returns how many moved; `hovers` follow.
// Throws Error (kInterrupted).
size_t MoveHovers(ViewGraph& graph, const MoveSetting& setting, std::vector<Hover>& hovers,
                  Progress& progress);

}  // namespace stucco::plan
