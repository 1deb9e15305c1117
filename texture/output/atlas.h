// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <span>
#include <vector>

#include "survey/image.h"
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

// Some of many pictures, in an atlas of theirs.
struct PackedAtlas {
  std::vector<size_t> pictures;
  AtlasLayout layout;  // in the order of `pictures`
};

// Packs pictures, each with its gutter, into as many atlases as it takes, none larger than that on
// either side and none empty. Requires pictures that fit into one.
std::vector<PackedAtlas> PackAtlases(std::span<const ImageSize> pictures, int side_px);

// Pictures and gutters where the layout has them, as `read` gives them by their place in it, in
// RGB. Between them is their mean colour, which is what the smallest mipmaps see of it.
Image PaintAtlas(const AtlasLayout& layout, const std::function<Image(size_t)>& read);

// Texture coordinates in a picture of that size, to those in the atlas where it lies at `place`.
Eigen::Vector2f InAtlas(const Eigen::Vector2f& uv, const ImageSize& picture,
                        const Eigen::Vector2i& place, const ImageSize& atlas);

}  // namespace stucco
