// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/tile_tree.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "texture/output/glb_parts.h"

namespace stucco {
namespace {

Eigen::AlignedBox3d BoxAround(const TiledFacet& facet) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : facet.facet->outer) box.extend(corner);
  return box;
}

// Of the part that is tiled, at full resolution.
ImageSize FullSize(const TiledFacet& facet) {
  if (facet.texture == nullptr) return {};
  return SizeOf(facet.part, {facet.texture->width_px, facet.texture->height_px});
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
  for (size_t i = 0; i < facets.size(); ++i) boxes[key_of(i)].extend(BoxAround(facets[i]));
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

// Of one facet, its picture.
std::pair<std::vector<TiledFacet>, std::vector<TiledFacet>> Divide(
    const std::vector<TiledFacet>& facets) {
  if (facets.size() > 1) return Halve(facets);
  const TiledFacet& facet = facets.front();
  const auto [first, second] =
      Halved(facet.part, {facet.texture->width_px, facet.texture->height_px});
  const GlbMesh mesh = GlbMeshOf(*facet.facet, facet.texture, Eigen::Isometry3d::Identity(), 0);
  const auto within = [&](const PicturePart& part) -> std::vector<TiledFacet> {
    const bool shows = std::ranges::any_of(mesh.primitives, [&](const GlbPrimitive& primitive) {
      return !ClippedTo(part, primitive).indices.empty();
    });
    if (!shows) return {};
    TiledFacet divided = facet;
    divided.part = part;
    return {divided};
  };
  return {within(first), within(second)};
}

// By which the pictures of a tile must be made smaller.
double ScaleWithin(const TileLimits& limits, const std::vector<TiledFacet>& facets) {
  double texels = 0;
  int longest_px = 1;
  for (const TiledFacet& facet : facets) {
    const ImageSize size = FullSize(facet);
    texels += static_cast<double>(size.width_px) * size.height_px;
    longest_px = std::max({longest_px, size.width_px, size.height_px});
  }
  const double by_side = static_cast<double>(limits.longest_px) / longest_px;
  const double by_texels = texels > limits.texels ? std::sqrt(limits.texels / texels) : 1;
  return std::min({1.0, by_side, by_texels});
}

ModelTile MakeTile(std::string name, std::vector<TiledFacet> facets, const TileLimits& limits) {
  ModelTile tile{std::move(name), std::move(facets), 1, 0, {}};
  tile.scale = ScaleWithin(limits, tile.facets);
  if (tile.scale == 1) return tile;
  for (const TiledFacet& facet : tile.facets) {
    if (facet.texture == nullptr) continue;
    tile.texel_m = std::max(tile.texel_m, facet.texture->metres_per_texel / tile.scale);
  }
  auto [first, second] = Divide(tile.facets);
  if (!first.empty()) tile.children.push_back(MakeTile(tile.name + "0", std::move(first), limits));
  if (!second.empty())
    tile.children.push_back(MakeTile(tile.name + "1", std::move(second), limits));
  return tile;
}

}  // namespace

ImageSize SizeInTile(const TiledFacet& facet, const ModelTile& tile) {
  const ImageSize full = FullSize(facet);
  if (facet.texture == nullptr) return full;
  const int longest = std::max(full.width_px, full.height_px);
  return ScaledSize(full, std::max(1, static_cast<int>(std::floor(tile.scale * longest))));
}

ModelTile BuildTileTree(const Proxy& proxy, const TextureSet& textures, const TileLimits& limits) {
  std::map<std::string, const TexturedFacet*> painted;
  for (const TexturedFacet& texture : textures.facets) {
    if (!texture.image.empty()) painted[texture.id] = &texture;
  }
  std::vector<TiledFacet> facets;
  for (size_t b = 0; b < proxy.buildings.size(); ++b) {
    for (const Facet& facet : proxy.buildings[b].facets) {
      const auto texture = painted.find(facet.id);
      facets.push_back({&facet, texture == painted.end() ? nullptr : texture->second,
                        static_cast<int>(b), kWholePicture});
    }
  }
  return MakeTile("r", std::move(facets), limits);
}

}  // namespace stucco
