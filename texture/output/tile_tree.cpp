// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/tile_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace stucco {
namespace {

Eigen::AlignedBox3d BoxOf(const TiledFacet& facet) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : facet.facet->outer) box.extend(corner);
  return box;
}

double NumTexels(const TiledFacet& facet) {
  if (facet.texture == nullptr) return 0;
  return static_cast<double>(facet.texture->width_px) * facet.texture->height_px;
}

// Orders what is to be divided by where it stands along the longer side of all.
template <typename Key>
void SortAlong(const std::map<Key, Eigen::AlignedBox3d>& boxes, std::vector<Key>& keys) {
  Eigen::AlignedBox3d centers;
  for (const auto& [key, box] : boxes) centers.extend(box.center());
  int axis = 0;
  centers.sizes().maxCoeff(&axis);
  std::stable_sort(keys.begin(), keys.end(), [&](const Key& a, const Key& b) {
    return boxes.at(a).center()[axis] < boxes.at(b).center()[axis];
  });
}

// Halves by number: of buildings while there are several.
std::pair<std::vector<TiledFacet>, std::vector<TiledFacet>> Halve(
    const std::vector<TiledFacet>& facets) {
  const bool several = facets.front().building != facets.back().building;
  std::map<int, Eigen::AlignedBox3d> boxes;
  const auto key_of = [&](size_t i) { return several ? facets[i].building : static_cast<int>(i); };
  for (size_t i = 0; i < facets.size(); ++i) boxes[key_of(i)].extend(BoxOf(facets[i]));
  std::vector<int> keys;
  keys.reserve(boxes.size());
  for (const auto& [key, box] : boxes) keys.push_back(key);
  SortAlong(boxes, keys);
  keys.resize(keys.size() / 2);
  std::sort(keys.begin(), keys.end());
  std::pair<std::vector<TiledFacet>, std::vector<TiledFacet>> halves;
  for (size_t i = 0; i < facets.size(); ++i) {
    const bool first = std::binary_search(keys.begin(), keys.end(), key_of(i));
    (first ? halves.first : halves.second).push_back(facets[i]);
  }
  return halves;
}

ModelTile MakeTile(std::string name, std::vector<TiledFacet> facets, double tile_texels) {
  ModelTile tile{std::move(name), std::move(facets), 1, 0, {}};
  double texels = 0;
  for (const TiledFacet& facet : tile.facets) texels += NumTexels(facet);
  if (texels <= tile_texels) return tile;
  tile.scale = std::sqrt(tile_texels / texels);
  for (const TiledFacet& facet : tile.facets) {
    if (facet.texture == nullptr) continue;
    tile.texel_m = std::max(tile.texel_m, facet.texture->metres_per_texel / tile.scale);
  }
  if (tile.facets.size() == 1) {
    tile.children.push_back({tile.name + "0", tile.facets, 1, 0, {}});
    return tile;
  }
  auto [first, second] = Halve(tile.facets);
  tile.children.push_back(MakeTile(tile.name + "0", std::move(first), tile_texels));
  tile.children.push_back(MakeTile(tile.name + "1", std::move(second), tile_texels));
  return tile;
}

}  // namespace

ImageSize SizeInTile(const TiledFacet& facet, const ModelTile& tile, int longest_px) {
  if (facet.texture == nullptr) return {};
  const ImageSize full{facet.texture->width_px, facet.texture->height_px};
  const int longest = std::max(full.width_px, full.height_px);
  const int scaled = std::max(1, static_cast<int>(std::floor(tile.scale * longest)));
  return ScaledSize(full, std::min(scaled, longest_px));
}

ModelTile BuildTileTree(const Proxy& proxy, const TextureSet& textures, double tile_texels) {
  std::map<std::string, const TexturedFacet*> painted;
  for (const TexturedFacet& texture : textures.facets) {
    if (!texture.image.empty()) painted[texture.id] = &texture;
  }
  std::vector<TiledFacet> facets;
  for (size_t b = 0; b < proxy.buildings.size(); ++b) {
    for (const Facet& facet : proxy.buildings[b].facets) {
      const auto texture = painted.find(facet.id);
      facets.push_back(
          {&facet, texture == painted.end() ? nullptr : texture->second, static_cast<int>(b)});
    }
  }
  return MakeTile("r", std::move(facets), tile_texels);
}

}  // namespace stucco
