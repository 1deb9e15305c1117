// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "survey/proxy.h"

namespace stucco::simulate {

using Loop = std::vector<Eigen::Vector3d>;

// Towards the side from which the corners are counter-clockwise; as long as the area (Newell).
// Relative to the first corner, so that far coordinates cost no digits.
Eigen::Vector3d AreaVector(const Loop& loop);

// A polygon of the truth: its plane through the corners, wholly seen.
Facet ExactFacet(FacetClass facet_class, Loop outer, std::vector<Loop> holes);

}  // namespace stucco::simulate
