// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "survey/proxy.h"

namespace stucco::evaluate {

// A planar facet from its outer ring, counter-clockwise seen from outside; its facade id is its id.
Facet MadeFacet(const std::string& id, FacetClass facet_class,
                const std::vector<Eigen::Vector3d>& outer);

// A closed box: walls F00 (south), F01 (east), F02 (north), F03 (west), R0 and G0.
Building MadeBox(const std::string& id, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Two houses of 10 x 8 x 6 m and 8 x 8 x 9 m with an alley of 12 m between them, on the ground
// z = 0 that reaches 15 m around them and is cut out below them.
Proxy MadeTruth();

}  // namespace stucco::evaluate
