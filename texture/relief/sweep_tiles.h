// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "survey/proxy.h"
#include "texture/grid/grid.h"
#include "texture/relief/best_rectangle.h"
#include "texture/views/candidates.h"
#include "texture/views/look.h"

namespace stucco {

// Photos of a part of a raster, at most.
constexpr size_t kMostTilePhotos = 8;

// A photo that shows part of a raster.
struct TilePhoto {
  int photo = -1;
  std::vector<uint8_t> sees;  // by cell of the part, with its rim (WithRim)
};

// A part of a raster, and the photos that are compared there.
struct SweepTile {
  CellRectangle cells;
  std::vector<TilePhoto> photos;
  std::vector<Eigen::Vector2d> slants;  // by photo, see SlantOf
};

// Cuts a facet's raster into tiles of about six metres: a photo from ten metres shows a dozen
// metres of a wall, so that on a long one each part has its own photos. They are the ones that see
// most of the tile, squarely and finely (for a picture of texels of the size `texel`), no two of
// them from about the same side.
std::vector<SweepTile> CutForSweep(const Facet& facet, const TexelGrid& raster, double texel,
                                   const ViewLimits& limits, const PaintScene& scene);

}  // namespace stucco
