// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "texture/grid/grid.h"
#include "texture/selection/select.h"
#include "texture/views/candidates.h"

namespace stucco {

// Facets are often a little larger than the real surface; photos show background on the rest.

// 1 for texels behind which a photo taken at `camera` could show the sky: the ray through them does
// not go down clearly. White roofs, snow and pale water seen from above are no sky.
std::vector<uint8_t> FindSkyward(const TexelGrid& raster, const Eigen::Vector3d& camera,
                                 const Eigen::Vector3d& up);

// What is known of a photo over a raster besides its colours, per texel.
struct SkyClues {
  std::vector<uint8_t> no_points;  // the cloud has nothing here
  std::vector<uint8_t> skyward;    // see FindSkyward
};

// Texels without points of the cloud that could show the sky, look like it (bright, not warm,
// without contrast) and not like the wall where it has points become Sight::kBeyond. `rgb` are the
// photo's own colours.
void MarkSky(const TexelGrid& raster, const SkyClues& clues, const std::vector<float>& rgb,
             std::vector<Sight>& sight);

// Takes the owner from texels whose picture looks beyond the surface, in regions that reach the
// left, right or upper edge of the facet: they are filled from the wall instead. Regions that
// touch only the lower edge may be arcades, enclosed ones windows: these stay. So does everything
// when it would be more than 30 % of the facet: then the cloud is not to be trusted.
void DropBackground(const TexelGrid& raster, std::span<const uint16_t> inside,
                    std::span<const RasterPicture> pictures, std::vector<int>& owner);

}  // namespace stucco
