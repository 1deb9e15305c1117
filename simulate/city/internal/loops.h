// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/geometry2d.h"

namespace stucco::simulate::internal {

// The outlines of what counter-clockwise rings cover together, where rings that touch share whole
// edges from corner to corner (within a millimetre): edges that are there in both directions fall
// away. Counter-clockwise loops are outer ones, clockwise ones holes; no corner is on a straight
// line.
std::vector<Ring> JoinLoops(const std::vector<Ring>& rings);

// Gives every clockwise ring to the smallest counter-clockwise one around it.
std::vector<Polygon> PolygonsOf(const std::vector<Ring>& loops);

}  // namespace stucco::simulate::internal
