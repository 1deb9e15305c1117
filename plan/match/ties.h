// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <algorithm>
#include <span>
#include <string>
#include <vector>

#include "plan/match/connectivity.h"
#include "plan/match/photo_graph.h"

namespace stucco::plan {

// What every plan should have: each photo three partners, each photo of a facade two of them near
// in direction and scale (kCloseAngle_rad, kCloseRatio), and no group of photos that all others
// match from one place only.
inline constexpr int kFewestPartners = 3;
inline constexpr int kFewestClose = 2;

// The partners of a photo that count.
struct Ties {
  std::vector<Partner> strong;  // kEnoughStrength or more
  std::vector<uint32_t> close;  // of a photo of facades: near in direction and scale, apart
};

bool IsOfFacade(const Shot& shot);

// A photo taken at `position` would be no second one from where a close partner stands.
bool StandsApart(const MatchGraph& graph, const Ties& ties, const Eigen::Vector3d& position);

// Of all photos; `hovers` are those of the graph.
std::vector<Ties> TiesOf(const PhotoGraph& photos, std::span<const Hover> hovers, int threads);

Connectivity ConnectivityOf(const std::vector<Ties>& ties);

// Photos that one other, or all those of one hover, alone hold to the rest, or none. All rays of a
// hover meet in one point, so that nothing but records tells how large is what the group shows; and
// one photo that fails may lose them all.
struct LooseGroup {
  std::vector<uint32_t> photos;  // ascending
  int on = -1;                   // the hover; -1: none

  bool Holds(uint32_t photo) const { return std::ranges::binary_search(photos, photo); }
};

// All of them, beside the photos that hold together best.
std::vector<LooseGroup> LooseGroups(std::span<const PhotoPlace> places,
                                    const std::vector<Ties>& ties);

// What a photo lacks; 0 where nothing.
int LackingPartners(const Ties& ties);
int LackingClose(const Ties& ties, const Shot& shot);

}  // namespace stucco::plan
