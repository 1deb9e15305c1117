// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/site.h"

namespace stucco::simulate::internal {

// The outlines of what counter-clockwise rings cover together, where rings that touch share whole
// edges from corner to corner (within a millimetre): edges that are there in both directions fall
// away. Counter-clockwise loops are outer ones, clockwise ones holes; no corner is on a straight
// line.
std::vector<plan::Ring> JoinLoops(const std::vector<plan::Ring>& rings);

// Gives every clockwise ring to the smallest counter-clockwise one around it.
std::vector<plan::Polygon> PolygonsOf(const std::vector<plan::Ring>& loops);

}  // namespace stucco::simulate::internal
