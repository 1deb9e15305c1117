// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/match/photo_graph.h"
#include "plan/space/obstacles.h"
#include "survey/stage.h"

namespace stucco::plan {

// What every plan should have: each photo three partners, each photo of a facade two of them near
// in direction and scale (kCloseAngle_rad, kCloseRatio), and no part of the graph that hangs by one
// pair.
inline constexpr int kFewestPartners = 3;
inline constexpr int kFewestClose = 2;

// What adding links came to.
struct LinkReport {
  int photos = 0;
  int stops = 0;                  // of these at places of their own
  std::vector<PhotoPlace> loose;  // photos that still lack partners
  int parts = 1;                  // that the graph falls into
  int bridges = 0;                // pairs that alone hold two parts of it together
};

// Adds photos (ViewKind::kLink) between those that lack partners and the others: about the
// geometric mean in distance and half way in direction, at hovers that exist where one will do,
// else in the column above one, which the drone passes anyway, else at places of their own.
// Greedily, the photo first that serves most for what it costs. `hovers` gains shots and, at its
// end, hovers. Same result at any number of threads. Throws Error (kInterrupted).
LinkReport AddLinkPhotos(const MatchSetting& setting, const Obstacles& obstacles,
                         std::vector<Hover>& hovers, Progress& progress);

}  // namespace stucco::plan
