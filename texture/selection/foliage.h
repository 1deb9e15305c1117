// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "survey/image.h"
#include "texture/grid/grid.h"
#include "texture/selection/consensus.h"

namespace stucco {

// Leaves before a wall: too thin for the cloud, and where only two photos see the wall no majority
// knows them. A picture does not see a texel (Sight::kNot) around which it is green and restless as
// leaves are (excess green index: Woebbecke et al., "Color indices for weed identification", 1995)
// where the cloud, too, has something in front of the wall, or while pictures from elsewhere see it
// freely and none shows the same leaves there: what grows on the wall looks alike from everywhere,
// a tree before it does not. From elsewhere is what would
// show something `before` raster texels before the wall in another place. Leaves that end where a
// part of the wall that lies back does are a tree in a pane, and stay. Where that would take more
// than 30 % of what the pictures see of the facet, green is taken for the wall's own and nothing
// changes.
void DropFoliage(const FacetRaster& raster, double before, std::vector<RasterPicture>& pictures);

// The texels of a picture that show leaves, or are as green and restless as they are, where
// `painted` is not zero; told in cells of 8 texels.
std::vector<uint8_t> LeafTexels(const Image& picture, const std::vector<uint8_t>& painted);

}  // namespace stucco
