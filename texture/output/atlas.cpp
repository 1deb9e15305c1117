// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/atlas.h"

#include <algorithm>
#include <cassert>

// The library's own way to say that its functions are to be here, and here only.
#define STB_RECT_PACK_IMPLEMENTATION
#define STBRP_STATIC
#include <stb/stb_rect_pack.h>

namespace stucco {

AtlasLayout PackAtlas(std::span<const ImageSize> pictures, int width_px) {
  constexpr int kBoth = 2 * kAtlasGutter_px;
  std::vector<stbrp_rect> boxes(pictures.size());
  int total_height_px = 0;
  for (size_t i = 0; i < pictures.size(); ++i) {
    assert(pictures[i].width_px > 0 && pictures[i].width_px + kBoth <= width_px);
    boxes[i] = {
        static_cast<int>(i), pictures[i].width_px + kBoth, pictures[i].height_px + kBoth, 0, 0, 0};
    total_height_px += boxes[i].h;
  }
  std::vector<stbrp_node> nodes(width_px);
  stbrp_context context;
  stbrp_init_target(&context, width_px, std::max(1, total_height_px), nodes.data(), width_px);
  stbrp_pack_rects(&context, boxes.data(), static_cast<int>(boxes.size()));
  AtlasLayout layout{{1, 1}, std::vector<Eigen::Vector2i>(pictures.size())};
  for (const stbrp_rect& box : boxes) {
    assert(box.was_packed);
    layout.places[box.id] = {box.x + kAtlasGutter_px, box.y + kAtlasGutter_px};
    layout.size.width_px = std::max(layout.size.width_px, box.x + box.w);
    layout.size.height_px = std::max(layout.size.height_px, box.y + box.h);
  }
  return layout;
}

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

}  // namespace stucco
