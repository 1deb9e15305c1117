// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <vector>

namespace stucco {

// Labels for the cells of a rectangle: which label suits a cell, what a change of label between
// neighbours costs, and what every label in use costs as such.
struct LabelProblem {
  static constexpr float kForbidden = 1e4f;

  int width = 0;
  int height = 0;
  int labels = 0;
  std::vector<float> data;   // [cell * labels + label]; kForbidden: the label cannot be there
  std::vector<float> seams;  // [((cell * 2 + d) * labels + a) * labels + b], d = 0: to the right
                             // neighbour, 1: to the one below; a on this side; 0 where a == b
  double label_cost = 0;

  size_t cells() const { return static_cast<size_t>(width) * height; }
  float Data(size_t cell, int label) const { return data[cell * labels + label]; }
  float Seam(size_t cell, int direction, int a, int b) const {
    return seams[((cell * 2 + direction) * labels + a) * labels + b];
  }
};

// -1: a cell that no label may have.
using Labels = std::vector<int>;

double LabelEnergy(const LabelProblem& problem, const Labels& labels);

// Low-energy labels by alpha expansion (Boykov, Veksler, Zabih, "Fast Approximate Energy
// Minimization via Graph Cuts", 2001) with label costs (Delong, Osokin, Isack, Boykov, "Fast
// Approximate Energy Minimization with Label Costs", 2012). Starts from a greedy choice of few
// labels and also tries to drop each label as a whole. Deterministic.
Labels CutLabels(const LabelProblem& problem);

}  // namespace stucco
