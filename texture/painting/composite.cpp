// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/painting/composite.h"

#include <algorithm>

#include "texture/painting/blend.h"

namespace stucco {
namespace {

constexpr int kTileSide = 768;  // a multiple of 2^kBlendLevels, as kBlendMargin is

Tile Grown(const Tile& tile, int margin, const TexelGrid& grid) {
  Tile out;
  out.x = std::max(0, tile.x - margin);
  out.y = std::max(0, tile.y - margin);
  out.width = std::min(grid.width, tile.x + tile.width + margin) - out.x;
  out.height = std::min(grid.height, tile.y + tile.height + margin) - out.y;
  return out;
}

// Owners of a tile's texels inside the facet, by row.
std::vector<int> OwnersOf(const Tile& tile, const TexelGrid& grid, const std::vector<uint8_t>& mask,
                          const Ownership& ownership) {
  std::vector<int> owners(tile.size(), -1);
  for (int y = 0; y < tile.height; ++y) {
    for (int x = 0; x < tile.width; ++x) {
      const int column = tile.x + x;
      const int row = tile.y + y;
      if (!mask[static_cast<size_t>(row) * grid.width + column]) continue;
      owners[static_cast<size_t>(y) * tile.width + x] =
          ownership.owner[ownership.RasterIndex(column, row)];
    }
  }
  return owners;
}

std::vector<uint8_t> FindPresent(const std::vector<int>& owners, size_t count) {
  std::vector<uint8_t> present(count, 0);
  for (int owner : owners) {
    if (owner >= 0) present[owner] = 1;
  }
  return present;
}

Layer MakeLayer(const PhotoLayer& chosen, int index, const TexelGrid& grid, const Tile& tile,
                const Ownership& ownership) {
  SampledTile sampled = SamplePhoto(*chosen.photo, *chosen.open(), grid, tile, chosen.shift);
  for (size_t i = 0; i < tile.size(); ++i) {
    for (int k = 0; k < 3; ++k) {
      float& value = sampled.rgb[3 * i + k];
      value = std::min(255.0f, value * static_cast<float>(chosen.gain[k]));
    }
    if (!sampled.valid[i]) continue;
    const int column = tile.x + static_cast<int>(i % tile.width);
    const int row = tile.y + static_cast<int>(i / tile.width);
    const size_t raster = ownership.RasterIndex(column, row);
    sampled.valid[i] = chosen.sight[raster] == Sight::kFree || ownership.owner[raster] == index;
  }
  return {std::move(sampled.rgb), std::move(sampled.valid)};
}

void StoreTile(const Tile& core, const Tile& padded, const std::vector<float>& rgb,
               const std::vector<int>& owners, Composite& out) {
  for (int y = 0; y < core.height; ++y) {
    for (int x = 0; x < core.width; ++x) {
      const int column = core.x + x;
      const int row = core.y + y;
      const size_t from = static_cast<size_t>(row - padded.y) * padded.width + (column - padded.x);
      uint8_t* pixel = out.picture.Pixel(column, row);
      for (int k = 0; k < 3; ++k) {
        pixel[k] = static_cast<uint8_t>(std::clamp(rgb[3 * from + k] + 0.5f, 0.0f, 255.0f));
      }
      out.labels[static_cast<size_t>(row) * out.picture.width_px + column] =
          static_cast<uint8_t>(owners[from] + 1);
    }
  }
}

// What a tile is painted from.
struct Sources {
  const TexelGrid& grid;
  const std::vector<uint8_t>& mask;
  const std::vector<PhotoLayer>& chosen;
  const Ownership& ownership;
  bool blend = true;
};

void PaintTile(const Tile& core, const Sources& sources, Composite& out) {
  const auto& [grid, mask, chosen, ownership, blend] = sources;
  Tile tile = Grown(core, kBlendMargin, grid);
  std::vector<int> owners = OwnersOf(tile, grid, mask, ownership);
  std::vector<uint8_t> present = FindPresent(owners, chosen.size());
  const auto count = std::count(present.begin(), present.end(), 1);
  if (count == 0) return;
  if (count == 1 || !blend) {
    tile = core;
    owners = OwnersOf(tile, grid, mask, ownership);
    present = FindPresent(owners, chosen.size());
  }
  std::vector<Layer> layers(chosen.size());
  for (size_t k = 0; k < chosen.size(); ++k) {
    if (present[k]) layers[k] = MakeLayer(chosen[k], static_cast<int>(k), grid, tile, ownership);
  }
  // The edge of a shifted photo can fall inside its region.
  for (size_t i = 0; i < owners.size(); ++i) {
    if (owners[i] >= 0 && !layers[owners[i]].valid[i]) owners[i] = -1;
  }
  const std::vector<float> rgb = blend ? BlendLayers(layers, owners, tile.width, tile.height)
                                       : JoinLayers(layers, owners, tile.width, tile.height);
  StoreTile(core, tile, rgb, owners, out);
}

}  // namespace

Composite ComposePicture(const TexelGrid& grid, const std::vector<uint8_t>& mask,
                         const std::vector<PhotoLayer>& chosen, const Ownership& ownership,
                         bool blend) {
  Composite out;
  out.picture.width_px = grid.width;
  out.picture.height_px = grid.height;
  out.picture.channels = 3;
  out.picture.data.assign(3 * grid.size(), 0);
  out.labels.assign(grid.size(), 0);
  const Sources sources{grid, mask, chosen, ownership, blend};
  for (int y = 0; y < grid.height; y += kTileSide) {
    for (int x = 0; x < grid.width; x += kTileSide) {
      const Tile core{x, y, std::min(kTileSide, grid.width - x),
                      std::min(kTileSide, grid.height - y)};
      PaintTile(core, sources, out);
    }
  }
  return out;
}

}  // namespace stucco
