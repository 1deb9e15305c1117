// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "survey/pixels.h"

namespace stucco {

// Where pictures lie in one large one.
struct AtlasLayout {
  ImageSize size;
  std::vector<Eigen::Vector2i> places;  // by picture, its top left texel
};

// Texels that repeat a picture's border around it, so that filters and the first two halvings of
// the atlas (mipmaps) do not mix neighbours.
inline constexpr int kAtlasGutter_px = 4;

// Packs pictures, each with a gutter around it, side by side into an atlas of at most that width
// (skyline packing, stb_rect_pack; Jylanki, "A thousand ways to pack the bin", 2010). The atlas is
// as high as it must be. Requires pictures that are not wider than the atlas less two gutters.
AtlasLayout PackAtlas(std::span<const ImageSize> pictures, int width_px);

// Puts a picture and its gutter into the atlas.
void PaintInAtlas(const Image& picture, const Eigen::Vector2i& place, Image& atlas);

}  // namespace stucco
