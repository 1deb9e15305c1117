// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "survey/pixels.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"
#include "texture/output/picture_part.h"

namespace stucco {

struct TiledFacet {
  const Facet* facet = nullptr;
  const TexturedFacet* texture = nullptr;  // null: nothing painted
  int building = 0;
  PicturePart part = kWholePicture;  // of the facet, as its picture has it
};

// A part of a model, at one level of detail.
struct ModelTile {
  std::string name;  // "r", its children "r0", "r1"
  std::vector<TiledFacet> facets;
  double scale = 1;    // by which pictures are made smaller
  double texel_m = 0;  // the largest texel after that, world units; 0 at full resolution
  std::vector<ModelTile>
      children;  // all of its facets once, at a finer scale; none at full resolution
};

// The size of a facet's picture in a tile, of the part that the tile has; nothing painted: 0 x 0.
ImageSize SizeInTile(const TiledFacet& facet, const ModelTile& tile);

// What a tile holds at most.
struct TileLimits {
  double texels = 0;   // of all pictures together
  int longest_px = 0;  // of one
};

// Levels of detail: the whole model in one tile whose pictures are made so small that they keep the
// limits, then each half of it (of buildings, then of a building's facets, along the longer side of
// where they stand, then of a facet's picture), until pictures have their full resolution.
ModelTile BuildTileTree(const Proxy& proxy, const TextureSet& textures, const TileLimits& limits);

}  // namespace stucco
