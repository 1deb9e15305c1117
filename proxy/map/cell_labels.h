// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <vector>

namespace stucco {

// Labels for the cells of any graph.
struct CellProblem {
  struct Link {
    int a = 0;
    int b = 0;
  };
  int labels = 0;
  std::vector<std::vector<double>> data;  // of each cell, by label; at least 0
  std::vector<Link> links;
  // Cost of labels la and lb on the cells of a link: at least 0, and 0 where they are equal.
  std::function<double(size_t link, int la, int lb)> border;
};

double EnergyOf(const CellProblem& problem, const std::vector<int>& labels);

// Cheap labels by alpha expansion (Boykov, Veksler, Zabih, "Fast Approximate Energy Minimization
// via Graph Cuts", 2001), from each cell's own cheapest label on, until no label grows any more.
// Border costs that are no metric are cut down to one inside a move, which is taken only when it
// saves. Deterministic. Requires at least one label.
std::vector<int> CheapestCellLabels(const CellProblem& problem);

}  // namespace stucco
