// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/map/roof_lines.h"

namespace stucco {

// Opens what open ground cuts off the rest of a part of the footprint, where it is small and most
// of it is far from all samples of the roofs it has: a tree over the corner of a garden that the
// map draws as house. Labels are of faces: a roof of `cover`, others (a level one without samples),
// or -1 where nothing stands; `inside` tells what of the arrangement is footprint.
void DropIslands(const Arrangement& arrangement, const CoverOfRoofs& cover, double far,
                 const std::vector<bool>& inside, std::vector<int>& labels);

}  // namespace stucco
