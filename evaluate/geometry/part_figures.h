// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "evaluate/figures/evaluation.h"
#include "evaluate/geometry/surface.h"

namespace stucco::evaluate {

// Points of the truth that a result should have, and how many photos show each (seen.h).
struct TruthPoints {
  std::vector<SurfacePoint> points;
  std::vector<char> showing;  // counted up to kPhotosToConfirm
};

// Points of a result: how far each is from the truth, and the group that it counts for.
struct ResultPoints {
  std::vector<double> distances;
  std::vector<int> groups;

  void Add(double distance, int group) {
    distances.push_back(distance);
    groups.push_back(group);
  }
};

// Figures of everything and of its parts; `found` says which of the truth's points have the result
// nearby. Requires `showing` and `found` by point of the truth.
PartFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                      std::span<const char> found);

// The same where it is known how far the result is from each of the truth's points.
PartFigures FiguresOf(const ResultPoints& result, const TruthPoints& truth,
                      std::span<const double> distances, double tolerance_m);

}  // namespace stucco::evaluate
