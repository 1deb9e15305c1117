// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/tiles_3d.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <assimp/Importer.hpp>
#include <map>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "tests/texture/khronos.h"
#include "tests/texture/synthetic.h"
#include "texture/output/tile_tree.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using test::MakeWall;
using test::TemporaryFolder;

constexpr int kPicture_px = 100;
constexpr double kTexel_m = 0.05;

// Walls of 5 m in a row along a street, two a building, each painted in a shade of its own; a
// building more whose wall is not painted.
class Street : public ::testing::Test {
 protected:
  explicit Street(int num_painted = 6) {
    fs::create_directories(folder_.path() / "textures");
    for (int i = 0; i <= num_painted; ++i) {
      if (i % 2 == 0)
        proxy_.buildings.push_back({fmt::format("B{:04}", i / 2), false, "map", "", {}});
      Facet wall = MakeWall(5, 5);
      wall.id = fmt::format("{}/W{:02}", proxy_.buildings.back().id, i % 2);
      for (auto& corner : wall.outer) corner.x() += 6 * i;
      if (i < num_painted) Paint(wall, 30 * i + 20);
      proxy_.buildings.back().facets.push_back(wall);
    }
    proxy_.metric = true;
  }

  void Paint(const Facet& wall, int shade) {
    Image image{kPicture_px, kPicture_px, 3, {}};
    image.data.assign(static_cast<size_t>(3) * kPicture_px * kPicture_px,
                      static_cast<uint8_t>(shade));
    TexturedFacet texture;
    texture.id = wall.id;
    texture.image = fmt::format("textures/{}.png", shade);
    texture.width_px = texture.height_px = kPicture_px;
    texture.metres_per_texel = kTexel_m;
    texture.origin = {wall.outer[0].x(), 0, 5};
    texture.v_axis = -Eigen::Vector3d::UnitZ();
    WriteImage(image, folder_.path() / texture.image);
    textures_.facets.push_back(texture);
  }

  json Write(const Georef& georef = {}, int atlas_px = 160) {
    WriteTiles3d(proxy_, {kOwnLook, textures_, folder_.path()}, georef, out_,
                 {.atlas_px = atlas_px, .jpeg_quality = 95, .threads = 2});
    return json::parse(ReadFile(out_ / "tileset.json"));
  }

  TemporaryFolder folder_;
  fs::path out_ = folder_.path() / "tiles3d";
  Proxy proxy_;
  TextureSet textures_;
};

std::set<std::string> IdsOf(const ModelTile& tile) {
  std::set<std::string> ids;
  for (const TiledFacet& facet : tile.facets) ids.insert(facet.facet->id);
  return ids;
}

void CheckLevels(const ModelTile& tile, double tile_texels) {
  double texels = 0;
  for (const TiledFacet& facet : tile.facets) {
    const ImageSize size = SizeInTile(facet, tile);
    texels += static_cast<double>(size.width_px) * size.height_px;
  }
  EXPECT_LE(texels, tile_texels) << tile.name;
  EXPECT_EQ(tile.children.empty(), tile.scale == 1) << tile.name;
  EXPECT_EQ(tile.children.empty(), tile.texel_m == 0) << tile.name;
  if (tile.children.empty()) return;
  std::set<std::string> below;
  size_t number = 0;
  for (const ModelTile& child : tile.children) {
    below.merge(IdsOf(child));
    number += child.facets.size();
    EXPECT_GE(child.scale, tile.scale);
    EXPECT_LE(child.texel_m, tile.texel_m);
    CheckLevels(child, tile_texels);
  }
  EXPECT_EQ(below, IdsOf(tile));
  // Each once, or one in two parts.
  EXPECT_EQ(number, tile.facets.size() == 1 ? 2 : tile.facets.size());
}

TEST_F(Street, EveryLevelHasAllFacetsInTheTexelsThatATileHas) {
  for (const double tile_texels : {5000.0, 9000.0, 25000.0, 1e9}) {
    const ModelTile root = BuildTileTree(proxy_, textures_, {tile_texels, 1 << 20});
    EXPECT_EQ(IdsOf(root).size(), 7u);
    CheckLevels(root, tile_texels);
  }
}

TEST_F(Street, AModelThatFitsIsOneTile) {
  EXPECT_TRUE(BuildTileTree(proxy_, textures_, {6e4, 1 << 20}).children.empty());
}

TEST_F(Street, BuildingsAreDividedBeforeTheirFacets) {
  const ModelTile root = BuildTileTree(proxy_, textures_, {2e4, 1 << 20});
  ASSERT_EQ(root.children.size(), 2u);
  EXPECT_EQ(IdsOf(root.children[0]), (std::set<std::string>{"B0000/W00", "B0000/W01",  //
                                                            "B0001/W00", "B0001/W01"}));
}

// All boxes of a tileset hold their children's, errors fall, contents are there.
void CheckTile(const json& tile, const fs::path& out, std::vector<std::string>& contents) {
  contents.push_back(tile["content"]["uri"]);
  EXPECT_TRUE(fs::exists(out / contents.back())) << contents.back();
  const std::vector<double> box = tile["boundingVolume"]["box"];
  ASSERT_EQ(box.size(), 12u);
  if (!tile.contains("children")) {
    EXPECT_EQ(tile["geometricError"], 0);
    return;
  }
  for (const json& child : tile["children"]) {
    EXPECT_LE(child["geometricError"], tile["geometricError"]);
    const std::vector<double> inner = child["boundingVolume"]["box"];
    for (int axis = 0; axis < 3; ++axis) {
      EXPECT_LE(std::abs(inner[axis] - box[axis]) + inner[3 + 4 * axis], box[3 + 4 * axis] + 1e-9);
    }
    CheckTile(child, out, contents);
  }
}

TEST_F(Street, TilesetAndContentsHangTogether) {
  const json tileset = Write();
  EXPECT_EQ(tileset["asset"]["version"], "1.1");
  EXPECT_EQ(tileset["root"]["refine"], "REPLACE");
  EXPECT_FALSE(tileset["root"].contains("transform"));
  EXPECT_GE(tileset["geometricError"], tileset["root"]["geometricError"]);
  std::vector<std::string> contents;
  CheckTile(tileset["root"], out_, contents);
  EXPECT_GT(contents.size(), 3u);
  size_t files = 0;
  for (const auto& entry : fs::directory_iterator(out_ / "tiles")) files += entry.is_regular_file();
  EXPECT_EQ(files, contents.size());
}

// What a viewer sees: in every tile each wall has the shade that was painted on it.
TEST_F(Street, EveryTileShowsEachWallItsOwnPicture) {
  const json tileset = Write();
  std::vector<std::string> contents;
  CheckTile(tileset["root"], out_, contents);
  std::map<std::string, int> shades;
  for (const TexturedFacet& facet : textures_.facets) {
    shades[facet.id] = std::stoi(fs::path(facet.image).stem().string());
  }
  for (const std::string& content : contents) {
    Assimp::Importer importer;
    const aiScene* scene =
        importer.ReadFile((out_ / content).string(), aiProcess_ValidateDataStructure);
    ASSERT_TRUE(scene) << importer.GetErrorString();
    ASSERT_LE(scene->mNumTextures, 1u);
    Image atlas;
    if (scene->mNumTextures == 1) {
      const aiTexture& texture = *scene->mTextures[0];
      WriteFile(out_ / "atlas.jpg",
                {reinterpret_cast<const char*>(texture.pcData), texture.mWidth});
      atlas = ReadImage(out_ / "atlas.jpg");
    }
    for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
      const aiMesh& mesh = *scene->mMeshes[m];
      const std::string id = mesh.mName.C_Str();
      ASSERT_EQ(mesh.HasTextureCoords(0), shades.contains(id)) << content << " " << id;
      if (!shades.contains(id)) continue;
      for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
        const aiVector3D& uv = mesh.mTextureCoords[0][v];  // assimp counts from the bottom
        const int x = std::min(static_cast<int>(uv.x * atlas.width_px), atlas.width_px - 1);
        const int y = std::min(static_cast<int>((1 - uv.y) * atlas.height_px), atlas.height_px - 1);
        EXPECT_NEAR(atlas.Pixel(x, y)[0], shades[id], 3) << content << " " << id;
      }
    }
  }
}

// A wall of 50 x 5 m whose picture of 1000 x 100 texels is larger than a tile, in the shape of an
// L, its shades brighter from left to right.
class LongWall : public Street {
 protected:
  LongWall() : Street(0) {
    Facet wall = MakeWall(50, 5);
    wall.id = "B0009/W00";
    wall.outer = {{0, 0, 0}, {50, 0, 0}, {50, 0, 5}, {30, 0, 5}, {30, 0, 2}, {0, 0, 2}};
    proxy_.buildings = {{"B0009", false, "map", "", {wall}}};
    Image image{1000, 100, 3, {}};
    for (int y = 0; y < 100; ++y) {
      for (int x = 0; x < 1000; ++x) image.data.insert(image.data.end(), 3, ShadeAt(x / 20.0));
    }
    TexturedFacet texture;
    texture.id = wall.id;
    texture.image = "textures/long.png";
    texture.width_px = 1000;
    texture.height_px = 100;
    texture.metres_per_texel = kTexel_m;
    texture.origin = {0, 0, 5};
    texture.v_axis = -Eigen::Vector3d::UnitZ();
    WriteImage(image, folder_.path() / texture.image);
    textures_.facets = {texture};
  }

  static uint8_t ShadeAt(double east) { return static_cast<uint8_t>(20 + 4 * east); }
};

TEST_F(LongWall, IsDividedUntilItsPictureHasItsFullResolution) {
  const json tileset = Write();
  std::vector<std::string> contents;
  CheckTile(tileset["root"], out_, contents);
  const double middle = proxy_.buildings[0].facets[0].outer[1].x() / 2;
  double area = 0;
  const auto look = [&](const json& tile, const auto& self) -> void {
    for (const json& child : tile.value("children", json::array())) self(child, self);
    Assimp::Importer importer;
    const std::string uri = tile["content"]["uri"];
    const aiScene* scene =
        importer.ReadFile((out_ / uri).string(), aiProcess_ValidateDataStructure);
    ASSERT_TRUE(scene) << importer.GetErrorString();
    ASSERT_EQ(scene->mNumTextures, 1u);
    WriteFile(out_ / "atlas.jpg", {reinterpret_cast<const char*>(scene->mTextures[0]->pcData),
                                   scene->mTextures[0]->mWidth});
    const Image atlas = ReadImage(out_ / "atlas.jpg");
    EXPECT_LE(atlas.width_px, 160);
    const aiMesh& mesh = *scene->mMeshes[0];
    for (unsigned v = 0; v < mesh.mNumVertices; ++v) {
      const aiVector3D& uv = mesh.mTextureCoords[0][v];
      const int x = std::min(static_cast<int>(uv.x * atlas.width_px), atlas.width_px - 1);
      const int y = std::min(static_cast<int>((1 - uv.y) * atlas.height_px), atlas.height_px - 1);
      EXPECT_NEAR(atlas.Pixel(x, y)[0], ShadeAt(mesh.mVertices[v].x + middle), 4) << uri;
    }
    if (tile.contains("children")) return;
    // At full resolution, a metre is 20 texels.
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const unsigned* corner = mesh.mFaces[f].mIndices;
      const auto size_of = [&](const auto& at, double x_scale, double y_scale) {
        const auto side = [&](unsigned k) {
          return Eigen::Vector2d((at(corner[k]) - at(corner[0])).array() *
                                 Eigen::Array2d(x_scale, y_scale));
        };
        const Eigen::Vector2d p = side(1), q = side(2);
        return std::abs(p.x() * q.y() - p.y() * q.x()) / 2;
      };
      const double metres2 = size_of(
          [&](unsigned v) { return Eigen::Vector2d(mesh.mVertices[v].x, mesh.mVertices[v].y); }, 1,
          1);
      const double texels = size_of(
          [&](unsigned v) {
            return Eigen::Vector2d(mesh.mTextureCoords[0][v].x, mesh.mTextureCoords[0][v].y);
          },
          atlas.width_px, atlas.height_px);
      EXPECT_NEAR(texels, 400 * metres2, 4 + 0.02 * texels) << uri;
      area += metres2;
    }
  };
  look(tileset["root"], look);
  EXPECT_NEAR(area, 50 * 2 + 20 * 3, 0.01);
}

TEST_F(LongWall, KhronosValidatorFindsNothingInItsTiles) {
  Write();
  size_t tiles = 0;
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    if (entry.path().extension() != ".glb") continue;
    ++tiles;
    const auto findings = test::KhronosFindings(entry.path());
    if (!findings) GTEST_SKIP() << "the Khronos validator is not installed";
    EXPECT_EQ(*findings, "") << entry.path();
  }
  EXPECT_GT(tiles, 8u);
}

TEST_F(Street, KhronosValidatorFindsNothingInTheTiles) {
  Write();
  for (const auto& entry : fs::recursive_directory_iterator(out_)) {
    if (entry.path().extension() != ".glb") continue;
    const auto findings = test::KhronosFindings(entry.path());
    if (!findings) GTEST_SKIP() << "the Khronos validator is not installed";
    EXPECT_EQ(*findings, "") << entry.path();
  }
}

TEST_F(Street, AGeoreferencedModelStandsOnTheEarth) {
  Georef georef;
  georef.frame = "enu";
  georef.origin_latitude_deg = 50;
  georef.origin_longitude_deg = 14;
  georef.origin_height_m = 300;
  georef.metric = true;
  const json tileset = Write(georef);
  const std::vector<double> values = tileset["root"]["transform"];
  ASSERT_EQ(values.size(), 16u);
  const Eigen::Matrix4d earth_from_tile = Eigen::Map<const Eigen::Matrix4d>(values.data());
  EXPECT_EQ(earth_from_tile.row(3), Eigen::RowVector4d(0, 0, 0, 1));
  // The middle of the street: 18 + 2.5 m east of the origin, 2.5 m above.
  const Eigen::Vector3d expected = EcefFromEnu(georef) * Eigen::Vector3d(20.5, 0, 2.5);
  EXPECT_LT((earth_from_tile.topRightCorner<3, 1>() - expected).norm(), 1e-6);
  const Eigen::Vector3d back = EcefFromEnu(georef).inverse() * expected;
  EXPECT_LT((EnuFromGeodetic(georef, 50, 14, 302.5) - Eigen::Vector3d(0, 0, 2.5)).norm(), 1e-6);
  EXPECT_LT((back - Eigen::Vector3d(20.5, 0, 2.5)).norm(), 1e-6);
}

TEST_F(Street, BytesDoNotDependOnThreads) {
  Write();
  std::map<std::string, std::string> first;
  for (const auto& entry : fs::directory_iterator(out_ / "tiles")) {
    first[entry.path().filename()] = ReadFile(entry.path());
  }
  WriteTiles3d(proxy_, {kOwnLook, textures_, folder_.path()}, {}, out_,
               {.atlas_px = 160, .jpeg_quality = 95, .threads = 1});
  for (const auto& [name, bytes] : first) EXPECT_EQ(ReadFile(out_ / "tiles" / name), bytes) << name;
}

TEST_F(Street, NothingToTileIsBadInput) {
  proxy_.buildings.clear();
  try {
    Write();
    FAIL() << "was written";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  }
  EXPECT_FALSE(fs::exists(out_));
}

TEST_F(Street, AMissingPictureIsNamed) {
  fs::remove(folder_.path() / textures_.facets[2].image);
  try {
    Write();
    FAIL() << "was written";
  } catch (const Error& error) {
    EXPECT_NE(std::string(error.what()).find(textures_.facets[2].image), std::string::npos)
        << error.what();
  }
  EXPECT_FALSE(fs::exists(out_ / "tileset.json"));
}

}  // namespace
}  // namespace stucco
