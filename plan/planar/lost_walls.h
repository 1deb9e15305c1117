// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/evaluate/facade_sight.h"

namespace stucco::plan {

// Those of the hovers of `full` that it takes to see every square metre of a facade that they see
// and the hovers of `kept` do not: thinning out knows walls by samples some metres apart, and a
// strip in a narrow yard may lie between them. Greedily, the one that shows the most of what is
// missing first. Indices into the hovers of `full`, ascending. Both are of the same site.
std::vector<uint32_t> HoversForLostWalls(const FacadeSight& full, const FacadeSight& kept,
                                         int threads);

// Adds a hover to others with all its photos: to the one that stands there, if there is one, which
// may have lost some.
void PutBack(const Hover& hover, std::vector<Hover>& hovers);

}  // namespace stucco::plan
