// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace stucco {

// What each of a row of labels costs at each cell of a raster: [cell * labels + label].
struct LabelCosts {
  int width = 0;
  int height = 0;
  int labels = 0;
  std::vector<float> costs;

  std::span<const float> Of(size_t cell) const {
    return std::span(costs).subspan(cell * labels, labels);
  }
};

// The label of each cell by semi-global matching (Hirschmüller, "Stereo Processing by Semiglobal
// Matching and Mutual Information", 2008) along eight directions: a step to the next label costs
// `small`, any other one `large`.
std::vector<int> MatchSemiGlobally(const LabelCosts& costs, float small, float large);

}  // namespace stucco
