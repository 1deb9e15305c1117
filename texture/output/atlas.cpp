// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/atlas.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <cstdint>

// The library's own way to say that its functions are to be here, and here only.
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

namespace stucco {

namespace {

constexpr int kBothGutters = 2 * kAtlasGutter_px;

// What of the boxes has room in a rectangle; each says whether it was packed, and where.
void Pack(const ImageSize& room, std::vector<stbrp_rect>& boxes) {
  std::vector<stbrp_node> nodes(room.width_px);
  stbrp_context context;
  stbrp_init_target(&context, room.width_px, room.height_px, nodes.data(), room.width_px);
  stbrp_setup_heuristic(&context, STBRP_HEURISTIC_Skyline_BF_sortHeight);
  stbrp_pack_rects(&context, boxes.data(), static_cast<int>(boxes.size()));
}

stbrp_rect BoxOf(size_t picture, const ImageSize& size) {
  assert(size.width_px > 0 && size.height_px > 0);
  return {static_cast<int>(picture),
          size.width_px + kBothGutters,
          size.height_px + kBothGutters,
          0,
          0,
          0};
}

Eigen::Vector2i PlaceIn(const stbrp_rect& box, AtlasLayout& layout) {
  layout.size.width_px = std::max(layout.size.width_px, box.x + box.w);
  layout.size.height_px = std::max(layout.size.height_px, box.y + box.h);
  return {box.x + kAtlasGutter_px, box.y + kAtlasGutter_px};
}

// Puts a picture and its gutter into the atlas.
void PaintInAtlas(const Image& picture, const Eigen::Vector2i& place, Image& atlas) {
  assert(picture.channels == atlas.channels);
  for (int y = -kAtlasGutter_px; y < picture.height_px + kAtlasGutter_px; ++y) {
    const int from_y = std::clamp(y, 0, picture.height_px - 1);
    for (int x = -kAtlasGutter_px; x < picture.width_px + kAtlasGutter_px; ++x) {
      const int from_x = std::clamp(x, 0, picture.width_px - 1);
      std::copy_n(picture.Pixel(from_x, from_y), picture.channels,
                  atlas.Pixel(place.x() + x, place.y() + y));
    }
  }
}

}  // namespace

AtlasLayout PackAtlas(std::span<const ImageSize> pictures, int width_px) {
  std::vector<stbrp_rect> boxes;
  int total_height_px = 1;
  for (const ImageSize& picture : pictures) {
    assert(picture.width_px + kBothGutters <= width_px);
    boxes.push_back(BoxOf(boxes.size(), picture));
    total_height_px += boxes.back().h;
  }
  Pack({width_px, total_height_px}, boxes);
  AtlasLayout layout{{1, 1}, std::vector<Eigen::Vector2i>(pictures.size())};
  for (const stbrp_rect& box : boxes) {
    assert(box.was_packed);
    layout.places[box.id] = PlaceIn(box, layout);
  }
  return layout;
}

std::vector<PackedAtlas> PackAtlases(std::span<const ImageSize> pictures, int side_px) {
  std::vector<stbrp_rect> left;
  for (const ImageSize& picture : pictures) {
    assert(std::max(picture.width_px, picture.height_px) + kBothGutters <= side_px);
    left.push_back(BoxOf(left.size(), picture));
  }
  std::vector<PackedAtlas> atlases;
  while (!left.empty()) {
    Pack({side_px, side_px}, left);
    PackedAtlas& atlas = atlases.emplace_back();
    for (const stbrp_rect& box : left) {
      if (!box.was_packed) continue;
      atlas.pictures.push_back(static_cast<size_t>(box.id));
      atlas.layout.places.push_back(PlaceIn(box, atlas.layout));
    }
    std::erase_if(left, [](const stbrp_rect& box) { return box.was_packed != 0; });
  }
  return atlases;
}

Image PaintAtlas(const AtlasLayout& layout, const std::function<Image(size_t)>& read) {
  const auto texels = static_cast<size_t>(layout.size.width_px) * layout.size.height_px;
  Image atlas{layout.size.width_px, layout.size.height_px, 3, std::vector<uint8_t>(3 * texels)};
  std::vector<uint8_t> painted(texels, 0);
  std::array<double, 3> sum = {0, 0, 0};
  double count = 0;
  for (size_t i = 0; i < layout.places.size(); ++i) {
    const Image picture = read(i);
    PaintInAtlas(picture, layout.places[i], atlas);
    for (size_t k = 0; k < picture.data.size(); ++k) sum[k % 3] += picture.data[k];
    count += static_cast<double>(picture.data.size()) / 3;
    const int left = layout.places[i].x() - kAtlasGutter_px;
    const int top = layout.places[i].y() - kAtlasGutter_px;
    for (int y = top; y < top + picture.height_px + kBothGutters; ++y) {
      std::fill_n(&painted[static_cast<size_t>(y) * layout.size.width_px + left],
                  picture.width_px + kBothGutters, uint8_t{1});
    }
  }
  for (size_t i = 0; i < texels; ++i) {
    for (size_t k = 0; k < 3 && painted[i] == 0 && count > 0; ++k) {
      atlas.data[3 * i + k] = static_cast<uint8_t>(std::lround(sum[k] / count));
    }
  }
  return atlas;
}

Eigen::Vector2f InAtlas(const Eigen::Vector2f& uv, const ImageSize& picture,
                        const Eigen::Vector2i& place, const ImageSize& atlas) {
  const auto vector = [](const ImageSize& size) {
    return Eigen::Array2f(static_cast<float>(size.width_px), static_cast<float>(size.height_px));
  };
  return (place.cast<float>().array() + uv.array() * vector(picture)) / vector(atlas);
}

}  // namespace stucco
