// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/path/candidates.h"

namespace stucco::plan {

// A number that no closed tour over all hovers costs less than, whichever ports it uses: the cost
// of a least 1-tree under weights raised by subgradient steps (Held and Karp, "The
// traveling-salesman problem and minimum spanning trees: part II", 1971). A tour leaves every port
// once, so that each port has a weight of its own: with one weight a hover, both of its edges could
// use the cheaper port. `tour_cost` of any tour
// sets the length of the steps. The steps look at candidate edges only; what is returned does not:
// it is the least 1-tree over all pairs, where pairs that are no candidates count with a cost that
// is at most the true one (straight line instead of safe path).
double TourLowerBound(const HoverCosts& costs,
                      std::span<const std::vector<TourCandidate>> candidates, double tour_cost);

}  // namespace stucco::plan
