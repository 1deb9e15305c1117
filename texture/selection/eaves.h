// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "texture/grid/grid.h"
#include "texture/selection/consensus.h"

namespace stucco {

// Of the ground: texels whose picture shows what stands over them take the cheapest of all pictures
// that show them freely, or lose their owner where none does and are filled from beside. But only
// in connected pieces that touch what nobody owns (the ground in a house) and that are nowhere
// wider than two times `half_width` raster texels: eaves, which a model of walls and roofs does not
// have. Cars and crowns of trees stay whole, as they are seen.
void ClearEaves(const TexelGrid& raster, std::span<const RasterPicture> pictures, double half_width,
                std::vector<int>& owner);

}  // namespace stucco
