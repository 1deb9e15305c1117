// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/path/candidates.h"

namespace stucco::plan {

// A closed tour to start from: the cheapest candidate edges that leave paths, then the paths one
// after the other, each time the one that begins nearest.
std::vector<int> GreedyTour(const HoverCosts& costs,
                            std::span<const std::vector<TourCandidate>> candidates);

}  // namespace stucco::plan
