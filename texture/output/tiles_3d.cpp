// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/tiles_3d.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "survey/encode_image.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/glb.h"
#include "survey/parallel.h"
#include "texture/output/atlas.h"
#include "texture/output/glb_parts.h"
#include "texture/output/tile_tree.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

// Pixels on the screen that viewers let a tile be wrong by, unless told otherwise.
constexpr double kUsualScreenError_px = 16;
constexpr double kPacked = 0.85;  // share of an atlas that pictures fill

// Where a tile's coordinates lie: z up, about the middle of the model.
struct TileFrame {
  Eigen::Isometry3d tile_from_world = Eigen::Isometry3d::Identity();
  Eigen::Isometry3d earth_from_tile = Eigen::Isometry3d::Identity();
};

Eigen::AlignedBox3d BoxOf(const std::vector<TiledFacet>& facets,
                          const Eigen::Isometry3d& tile_from_world) {
  Eigen::AlignedBox3d box;
  for (const TiledFacet& facet : facets) {
    Eigen::AlignedBox3d around;
    for (const Eigen::Vector3d& corner : facet.facet->outer) {
      around.extend(tile_from_world * corner);
    }
    if (facet.texture != nullptr && !IsWhole(facet.part)) {
      around = around.intersection(BoxOf(facet.part, *facet.texture, tile_from_world));
    }
    if (!around.isEmpty()) box.extend(around);
  }
  return box;
}

TileFrame FrameOf(const std::vector<TiledFacet>& facets, const Eigen::Vector3d& up,
                  const Georef& georef) {
  const Eigen::Vector3d middle = BoxOf(facets, Eigen::Isometry3d::Identity()).center();
  TileFrame frame;
  frame.tile_from_world = Eigen::Quaterniond::FromTwoVectors(up, Eigen::Vector3d::UnitZ()) *
                          Eigen::Translation3d(-middle);
  if (georef.frame == "enu") {
    frame.earth_from_tile = EcefFromEnu(georef) * frame.tile_from_world.inverse();
  }
  return frame;
}

// The pictures of a tile in one, and where each lies.
struct TilePicture {
  AtlasLayout layout;
  std::vector<ImageSize> sizes;  // by facet; 0 x 0: none
  std::string jpeg;              // empty: nothing is painted
};

TilePicture PictureOf(const ModelTile& tile, const fs::path& folder,
                      const Tiles3dOptions& options) {
  TilePicture picture;
  std::vector<ImageSize> painted;
  for (const TiledFacet& facet : tile.facets) {
    picture.sizes.push_back(SizeInTile(facet, tile));
    if (facet.texture != nullptr) painted.push_back(picture.sizes.back());
  }
  if (painted.empty()) return picture;
  const AtlasLayout packed = PackAtlas(painted, options.atlas_px);
  picture.layout.size = packed.size;
  picture.layout.places.resize(tile.facets.size());
  std::vector<size_t> facets;  // in the order of the atlas
  for (size_t i = 0; i < tile.facets.size(); ++i) {
    if (tile.facets[i].texture == nullptr) continue;
    picture.layout.places[i] = packed.places[facets.size()];
    facets.push_back(i);
  }
  const Image atlas = PaintAtlas(packed, [&](size_t i) {
    const TiledFacet& facet = tile.facets[facets[i]];
    return ReadPart(*facet.texture, folder, facet.part, picture.sizes[facets[i]]);
  });
  picture.jpeg = EncodeImage(atlas, "atlas.jpg", options.jpeg_quality);
  return picture;
}

void MoveIntoAtlas(const TilePicture& picture, size_t facet, GlbMesh& mesh) {
  for (GlbPrimitive& primitive : mesh.primitives) {
    for (Eigen::Vector2f& uv : primitive.uv) {
      uv = InAtlas(uv, picture.sizes[facet], picture.layout.places[facet], picture.layout.size);
    }
  }
}

std::string TileGlb(const ModelTile& tile, const TileFrame& frame, const fs::path& pictures,
                    const Tiles3dOptions& options) {
  TilePicture picture = PictureOf(tile, pictures, options);
  GlbModel glb;
  glb.repeat_textures = false;
  glb.materials = {GlbMaterialOf("untextured", -1)};
  if (!picture.jpeg.empty()) {
    glb.materials.push_back(GlbMaterialOf("facets", 0));
    glb.textures.push_back({std::move(picture.jpeg), "image/jpeg"});
  }
  const Eigen::Isometry3d glb_from_world = YUpFromZUp() * frame.tile_from_world;
  for (size_t i = 0; i < tile.facets.size(); ++i) {
    const auto& [facet, texture, building, part] = tile.facets[i];
    GlbMesh mesh = GlbMeshOf(*facet, texture, glb_from_world, texture == nullptr ? 0 : 1);
    if (texture != nullptr && !IsWhole(part)) {
      for (GlbPrimitive& primitive : mesh.primitives) primitive = ClippedTo(part, primitive);
      std::erase_if(mesh.primitives, [](const GlbPrimitive& p) { return p.indices.empty(); });
    }
    if (mesh.primitives.empty()) continue;
    if (texture != nullptr) MoveIntoAtlas(picture, i, mesh);
    glb.meshes.push_back(std::move(mesh));
  }
  return GlbBytes(glb);
}

// A box as 3D Tiles has it: its middle and half of each side.
Json VolumeOf(const Eigen::AlignedBox3d& box) {
  const Eigen::Vector3d c = box.center();
  const Eigen::Vector3d h = (box.sizes() / 2).cwiseMax(1e-3);  // a volume, of a single facet too
  return {{"box", {c.x(), c.y(), c.z(), h.x(), 0, 0, 0, h.y(), 0, 0, 0, h.z()}}};
}

Json JsonOf(const ModelTile& tile, const TileFrame& frame) {
  Json json = {{"boundingVolume", VolumeOf(BoxOf(tile.facets, frame.tile_from_world))},
               {"geometricError", kUsualScreenError_px * tile.texel_m},
               {"refine", "REPLACE"},
               {"content", {{"uri", fmt::format("tiles/{}.glb", tile.name)}}}};
  if (tile.children.empty()) return json;
  json["children"] = Json::array();
  for (const ModelTile& child : tile.children) json["children"].push_back(JsonOf(child, frame));
  return json;
}

void Collect(const ModelTile& tile, std::vector<const ModelTile*>& tiles) {
  tiles.push_back(&tile);
  for (const ModelTile& child : tile.children) Collect(child, tiles);
}

Json TilesetOf(const ModelTile& root, const TileFrame& frame) {
  Json tile = JsonOf(root, frame);
  if (!frame.earth_from_tile.matrix().isIdentity(0)) {
    tile["transform"] = Json::array();  // column by column, as Eigen keeps it
    for (const double value : frame.earth_from_tile.matrix().reshaped()) {
      tile["transform"].push_back(value);
    }
  }
  return {{"asset", {{"version", "1.1"}, {"generator", "stucco"}}},
          {"geometricError", BoxOf(root.facets, frame.tile_from_world).diagonal().norm()},
          {"root", tile}};
}

}  // namespace

void WriteTiles3d(const Proxy& proxy, const ModelLook& look, const Georef& georef,
                  const fs::path& out, const Tiles3dOptions& options) {
  const TileLimits limits{kPacked * options.atlas_px * options.atlas_px,
                          options.atlas_px - 2 * kAtlasGutter_px};
  const ModelTile root = BuildTileTree(proxy, look.textures, limits);
  if (root.facets.empty()) {
    throw Error(ErrorKind::kBadInput, "the model has no facets: there is nothing to tile");
  }
  const TileFrame frame = FrameOf(root.facets, proxy.up, georef);
  std::vector<const ModelTile*> tiles;
  Collect(root, tiles);
  std::error_code error;
  fs::create_directories(out / "tiles", error);  // writing a file says what is wrong
  ParallelFor(tiles.size(), options.threads, [&](size_t i) {
    WriteFile(out / "tiles" / (tiles[i]->name + ".glb"),
              TileGlb(*tiles[i], frame, look.folder, options));
  });
  // Last, so that it names what is there.
  WriteFile(out / "tileset.json", TilesetOf(root, frame).dump(1) + "\n");
}

}  // namespace stucco
