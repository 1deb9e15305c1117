// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

namespace stucco {

struct CutNode {
  double cost_in = 0;   // paid when the node is labelled in
  double cost_out = 0;  // paid when it is labelled out
};

struct CutLink {
  int a = 0;
  int b = 0;
  double cost = 0;  // paid when the labels differ
};

// The cheapest labelling (true: in) of a two-label energy with non-negative costs, as a minimum
// cut. Costs are rounded to 2^-50 of their sum.
std::vector<bool> CheapestLabels(std::span<const CutNode> nodes, std::span<const CutLink> links);

}  // namespace stucco
