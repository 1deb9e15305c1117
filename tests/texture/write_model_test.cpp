// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/write_model.h"

#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cmath>
#include <cstring>
#include <map>
#include <nlohmann/json.hpp>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/image.h"
#include "tests/texture/khronos.h"
#include "tests/texture/synthetic.h"
#include "texture/grid/relief_file.h"
#include "texture/output/orthophoto.h"
#include "texture/output/write_glb.h"

namespace stucco {
namespace {

using nlohmann::json;
using test::MakeProxy;
using test::MakeWall;
using test::TemporaryFolder;

void WriteGlb(const Proxy& proxy, const TextureSet& textures, const std::filesystem::path& folder,
              const GlbOptions& options) {
  const ModelLook look{kOwnLook, textures, folder};
  WriteFile(folder / "model.glb", GlbOfLooks(proxy, {&look, 1}, options));
}

// A textured wall with a hole and an untextured one behind it.
class Model : public ::testing::Test {
 protected:
  Model() {
    Facet wall = MakeWall(4, 3);
    wall.holes = {{{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}}};
    Facet back = MakeWall(2, 2);
    back.id = "B0001/W02";
    for (auto& vertex : back.outer) vertex.y() += 1;
    proxy_ = MakeProxy({wall, back});

    std::filesystem::create_directories(folder_.path() / "textures");
    Image image;
    image.width_px = 40;
    image.height_px = 30;
    image.data.assign(3600, 50);
    for (int y = 0; y < 30; ++y) {
      for (int x = 0; x < 20; ++x) image.Pixel(x, y)[0] = 250;  // the left half is red
    }
    WriteImage(image, folder_.path() / "textures/B0001_W01.png");

    TexturedFacet textured;
    textured.id = wall.id;
    textured.image = "textures/B0001_W01.png";
    textured.width_px = 40;
    textured.height_px = 30;
    textured.metres_per_texel = 0.1;
    textured.origin = {0, 0, 3};
    textured.v_axis = -Eigen::Vector3d::UnitZ();
    TexturedFacet plain;
    plain.id = back.id;
    textures_.facets = {textured, plain};
  }

  std::string Glb(const char* name = "model.glb") { return ReadFile(folder_.path() / name); }
  json GlbJson() {
    const std::string glb = Glb();
    uint32_t length = 0;
    std::memcpy(&length, &glb[12], 4);
    return json::parse(glb.substr(20, length));
  }
  std::string GlbBinary() {
    const std::string glb = Glb();
    uint32_t length = 0;
    std::memcpy(&length, &glb[12], 4);
    return glb.substr(20 + length + 8);
  }

  TemporaryFolder folder_;
  Proxy proxy_;
  TextureSet textures_;
};

TEST_F(Model, ObjReadsBackWithTextureCoordinates) {
  WriteObj(proxy_, textures_, folder_.path());
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile((folder_.path() / "model.obj").string(), aiProcess_ValidateDataStructure);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2u);
  const aiMesh* wall = nullptr;
  for (unsigned i = 0; i < scene->mNumMeshes; ++i) {
    if (std::string(scene->mMeshes[i]->mName.C_Str()) == "B0001/W01") wall = scene->mMeshes[i];
  }
  ASSERT_TRUE(wall);
  ASSERT_TRUE(wall->HasTextureCoords(0));
  for (unsigned i = 0; i < wall->mNumVertices; ++i) {
    const aiVector3D& at = wall->mVertices[i];
    const aiVector3D& uv = wall->mTextureCoords[0][i];
    EXPECT_NEAR(uv.x, at.x / 4, 1e-5);
    EXPECT_NEAR(uv.y, at.z / 3, 1e-5);  // OBJ counts from the bottom
  }
  aiString path;
  ASSERT_EQ(scene->mMaterials[wall->mMaterialIndex]->GetTexture(aiTextureType_DIFFUSE, 0, &path),
            aiReturn_SUCCESS);
  EXPECT_STREQ(path.C_Str(), "textures/B0001_W01.png");
}

TEST_F(Model, ObjKeepsTheAreaOfPolygonsWithHoles) {
  WriteObj(proxy_, textures_, folder_.path());
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_.path() / "model.obj").string(), 0);
  ASSERT_TRUE(scene);
  double area = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh* mesh = scene->mMeshes[m];
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
      const unsigned* index = mesh->mFaces[f].mIndices;
      const aiVector3D a = mesh->mVertices[index[0]];
      const aiVector3D cross = (mesh->mVertices[index[1]] - a) ^ (mesh->mVertices[index[2]] - a);
      area += -0.5 * cross.y;  // both walls face south
    }
  }
  EXPECT_NEAR(area, 11 + 4, 1e-4);
}

TEST_F(Model, GlbIsValidAndEmbedsItsPictures) {
  WriteGlb(proxy_, textures_, folder_.path(), {4096, 90});
  const std::string glb = Glb();
  uint32_t header[3];
  std::memcpy(header, glb.data(), 12);
  EXPECT_EQ(header[0], 0x46546C67u);
  EXPECT_EQ(header[1], 2u);
  EXPECT_EQ(header[2], glb.size());
  const json gltf = GlbJson();
  ASSERT_EQ(gltf.at("images").size(), 1u);
  const json& image = gltf["images"][0];
  EXPECT_EQ(image.at("mimeType"), "image/jpeg");
  EXPECT_FALSE(image.contains("uri"));
  const json& view = gltf["bufferViews"][image.at("bufferView").get<int>()];
  const std::string jpeg =
      GlbBinary().substr(view.value("byteOffset", 0), view.at("byteLength").get<size_t>());
  WriteFile(folder_.path() / "embedded.jpg", jpeg);
  const Image picture = ReadJpeg(folder_.path() / "embedded.jpg");
  EXPECT_EQ(picture.width_px, 40);
  EXPECT_GT(picture.Pixel(5, 15)[0], 200);
  EXPECT_LT(picture.Pixel(35, 15)[0], 100);
  ASSERT_EQ(gltf["buffers"].size(), 1u);
  EXPECT_FALSE(gltf["buffers"][0].contains("uri"));
  EXPECT_LE(gltf["buffers"][0].at("byteLength").get<size_t>(), GlbBinary().size());
  size_t unlit = 0;
  for (const json& material : gltf["materials"]) {
    unlit +=
        material.contains("extensions") && material["extensions"].contains("KHR_materials_unlit");
  }
  EXPECT_EQ(unlit, gltf["materials"].size());
}

TEST_F(Model, KhronosValidatorFindsNothingInTheGlb) {
  WriteGlb(proxy_, textures_, folder_.path(), {4096, 90});
  const auto findings = test::KhronosFindings(folder_.path() / "model.glb");
  if (!findings) GTEST_SKIP() << "the Khronos validator is not installed";
  EXPECT_EQ(*findings, "");
}

TEST_F(Model, GlbReadsBackYUpWithTextureCoordinates) {
  WriteGlb(proxy_, textures_, folder_.path(), {64, 90, 1, 300});
  Assimp::Importer importer;
  const aiScene* scene =
      importer.ReadFile((folder_.path() / "model.glb").string(), aiProcess_ValidateDataStructure);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2u);
  const aiMesh* wall = scene->mMeshes[0];
  ASSERT_TRUE(wall->HasTextureCoords(0));
  for (unsigned i = 0; i < wall->mNumVertices; ++i) {
    const aiVector3D& at = wall->mVertices[i];  // (east, up, south)
    EXPECT_NEAR(at.z, 0, 1e-6);
    EXPECT_NEAR(wall->mTextureCoords[0][i].x, at.x / 4, 1e-5);
    EXPECT_NEAR(wall->mTextureCoords[0][i].y, at.y / 3, 1e-5);
  }
  ASSERT_EQ(scene->mNumTextures, 1u);
  EXPECT_STREQ(scene->mTextures[0]->achFormatHint, "jpg");
  ASSERT_EQ(scene->mRootNode->mNumChildren, 2u);
  EXPECT_STREQ(scene->mRootNode->mChildren[0]->mName.C_Str(), "B0001/W01");
}

TEST_F(Model, OffsetIsTakenOffWhereCoordinatesAreLarge) {
  EXPECT_EQ(ModelOffset(proxy_), Eigen::Vector3d::Zero());
  EXPECT_EQ(ModelOffset({}), Eigen::Vector3d::Zero());
  const Eigen::Vector3d utm(389123.4, 5819456.7, 33);
  Proxy far = proxy_;
  for (Facet& facet : far.buildings[0].facets) {
    facet.offset += facet.normal.dot(utm);
    for (auto& vertex : facet.outer) vertex += utm;
    for (auto& hole : facet.holes) {
      for (auto& vertex : hole) vertex += utm;
    }
  }
  textures_.facets[0].origin += utm;
  textures_.model_offset = ModelOffset(far);
  EXPECT_EQ(textures_.model_offset, Eigen::Vector3d(389000, 5819000, 0));
  WriteObj(far, textures_, folder_.path());
  WriteGlb(far, textures_, folder_.path(), {64, 90});
  EXPECT_EQ(ReadFile(folder_.path() / "model.obj").substr(0, 42),
            "# add 389000 5819000 0 for world coordinat");
  EXPECT_EQ(GlbJson().at("asset").at("extras").at("offset"), json({389000.0, 5819000.0, 0.0}));

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_.path() / "model.glb").string(), 0);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  const aiMesh* wall = scene->mMeshes[0];
  for (unsigned i = 0; i < wall->mNumVertices; ++i) {
    const aiVector3D& at = wall->mVertices[i];  // (east, up, south)
    EXPECT_NEAR(at.z, -456.7, 1e-4);
    EXPECT_NEAR(wall->mTextureCoords[0][i].x, (at.x - 123.4) / 4, 1e-4);
    EXPECT_NEAR(wall->mTextureCoords[0][i].y, (at.y - 33) / 3, 1e-4);
  }
}

TEST_F(Model, PicturesInsideAreMadeSmallerTogether) {
  TexturedFacet second = textures_.facets[0];
  second.id = "B0001/W02";
  textures_.facets[1] = second;
  WriteGlb(proxy_, textures_, folder_.path(), {64, 90, 2, 600});  // of 2400
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_.path() / "model.glb").string(), 0);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumTextures, 2u);
  for (unsigned i = 0; i < 2; ++i) {
    const auto* bytes = reinterpret_cast<const char*>(scene->mTextures[i]->pcData);
    WriteFile(folder_.path() / "embedded.jpg", std::string(bytes, scene->mTextures[i]->mWidth));
    EXPECT_EQ(ReadJpegSize(folder_.path() / "embedded.jpg").width_px, 20);
    EXPECT_EQ(ReadJpegSize(folder_.path() / "embedded.jpg").height_px, 15);
  }
}

// Two walls in one picture: each is drawn with its own part of it.
TEST_F(Model, FacetsShareAnAtlas) {
  const Image green{20, 20, 3, [] {
                      std::vector<uint8_t> data(1200, 30);
                      for (size_t i = 1; i < data.size(); i += 3) data[i] = 220;
                      return data;
                    }()};
  WriteImage(green, folder_.path() / "textures/B0001_W02.png");
  TexturedFacet& second = textures_.facets[1];
  second = textures_.facets[0];
  second.id = "B0001/W02";
  second.image = "textures/B0001_W02.png";
  second.width_px = second.height_px = 20;
  second.origin = {0, 1, 2};
  GlbOptions options;
  options.atlas_px = 128;
  WriteGlb(proxy_, textures_, folder_.path(), options);
  const json gltf = GlbJson();
  ASSERT_EQ(gltf["images"].size(), 1u);
  ASSERT_EQ(gltf["materials"].size(), 2u);
  ASSERT_EQ(gltf["meshes"].size(), 2u);

  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_.path() / "model.glb").string(), 0);
  ASSERT_TRUE(scene) << importer.GetErrorString();
  const aiTexture& embedded = *scene->mTextures[0];
  WriteFile(folder_.path() / "embedded.jpg",
            std::string(reinterpret_cast<const char*>(embedded.pcData), embedded.mWidth));
  const Image atlas = ReadImage(folder_.path() / "embedded.jpg");
  const auto colour = [&](const aiMesh& mesh, unsigned vertex) {
    const aiVector3D uv = mesh.mTextureCoords[0][vertex];  // from the bottom, as assimp has it
    const auto x = static_cast<int>(std::lround(uv.x * static_cast<float>(atlas.width_px)));
    const auto y = static_cast<int>(std::lround((1 - uv.y) * static_cast<float>(atlas.height_px)));
    return atlas.Pixel(std::min(x, atlas.width_px - 1), std::min(y, atlas.height_px - 1));
  };
  for (unsigned m = 0; m < 2; ++m) {
    const aiMesh& mesh = *scene->mMeshes[m];
    const bool is_green = std::string(mesh.mName.C_Str()) == "B0001/W02";
    for (unsigned i = 0; i < mesh.mNumVertices; ++i) {
      const uint8_t* rgb = colour(mesh, i);
      if (!is_green && mesh.mVertices[i].x == 2) continue;  // where red ends
      const bool is_red = !is_green && mesh.mVertices[i].x < 2;
      EXPECT_NEAR(rgb[0], is_green ? 30 : is_red ? 250 : 50, 25) << m << ' ' << i;
      EXPECT_NEAR(rgb[1], is_green ? 220 : 50, 25) << m << ' ' << i;
    }
  }
  if (const auto findings = test::KhronosFindings(folder_.path() / "model.glb")) {
    EXPECT_EQ(*findings, "");
  }
}

// The wall is blue on a later day, when what is behind it was seen for the first time.
// The wall's picture of 40 x 30 texels in tiles of at most 16: four across, two down. Every place
// of the wall is in one of them, with the texel that it has in the whole picture.
TEST_F(Model, LargePicturesAreCutIntoTiles) {
  WriteGlb(proxy_, textures_, folder_.path(), {.max_px = 16});
  const json gltf = GlbJson();
  ASSERT_EQ(gltf["meshes"].size(), 2u);  // a mesh a facet, as ever
  const json& tiles = gltf["meshes"][0]["primitives"];
  ASSERT_EQ(tiles.size(), 8u);
  EXPECT_EQ(gltf["images"].size(), 8u);
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder_.path() / "model.glb").string(), 0);
  ASSERT_TRUE(scene);
  double area = 0;
  std::map<std::pair<int, int>, int> seen;  // tiles by the place of their first corner
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) {
    const aiMesh* mesh = scene->mMeshes[m];
    if (!mesh->HasTextureCoords(0)) continue;
    for (unsigned f = 0; f < mesh->mNumFaces; ++f) {
      const unsigned* index = mesh->mFaces[f].mIndices;
      const aiVector3D a = mesh->mVertices[index[0]];
      area += 0.5 * ((mesh->mVertices[index[1]] - a) ^ (mesh->mVertices[index[2]] - a)).Length();
    }
    // Coordinates of a tile of 10 x 15 texels go from 0 to 1 over 1 m and 1.5 m.
    const aiVector3D at = mesh->mVertices[0], uv = mesh->mTextureCoords[0][0];
    const double left = at.x - uv.x * 1.0, below = at.y - uv.y * 1.5;
    EXPECT_NEAR(left, std::round(left), 1e-5);
    EXPECT_NEAR(below / 1.5, std::round(below / 1.5), 1e-5);
    ++seen[{static_cast<int>(std::lround(left)), static_cast<int>(std::lround(below / 1.5))}];
  }
  EXPECT_NEAR(area, 11, 1e-4);
  EXPECT_EQ(seen.size(), 8u);
}

TEST_F(Model, TilesOfLooksAreVariants) {
  const std::vector<ModelLook> looks = {{"now", textures_, folder_.path()},
                                        {"then", textures_, folder_.path()}};
  WriteFile(folder_.path() / "model.glb", GlbOfLooks(proxy_, looks, {.max_px = 16}));
  const json gltf = GlbJson();
  EXPECT_EQ(gltf["images"].size(), 16u);
  for (const json& tile : gltf["meshes"][0]["primitives"]) {
    const json& mappings = tile["extensions"]["KHR_materials_variants"]["mappings"];
    ASSERT_EQ(mappings.size(), 1u);  // the first look is what it has without a variant
    EXPECT_EQ(mappings[0]["variants"], json({1}));
    EXPECT_NE(mappings[0]["material"], tile["material"]);
  }
  if (const auto findings = test::KhronosFindings(folder_.path() / "model.glb")) {
    EXPECT_EQ(*findings, "");
  }
}

// Each of two epochs gave the facet its first picture, one of them with larger texels.
TEST_F(Model, LooksOfOtherSizesHaveTheSameTiles) {
  const std::filesystem::path coarse = folder_.path() / "coarse";
  std::filesystem::create_directories(coarse / "textures");
  WriteImage(Image{20, 15, 3, std::vector<uint8_t>(900, 90)}, coarse / "textures/B0001_W01.png");
  TextureSet none = textures_, larger = textures_;
  none.facets[0].image.clear();
  larger.facets[0].width_px = 20;
  larger.facets[0].height_px = 15;
  larger.facets[0].metres_per_texel *= 2;
  const std::vector<ModelLook> looks = {{kOwnLook, none, folder_.path()},
                                        {"coarse", larger, coarse},
                                        {"fine", textures_, folder_.path()}};
  WriteFile(folder_.path() / "model.glb", GlbOfLooks(proxy_, looks, {.max_px = 16}));
  const json gltf = GlbJson();
  ASSERT_EQ(gltf["meshes"][0]["primitives"].size(), 8u);
  for (const json& tile : gltf["meshes"][0]["primitives"]) {
    const json& mappings = tile["extensions"]["KHR_materials_variants"]["mappings"];
    ASSERT_EQ(mappings.size(), 2u);
    EXPECT_EQ(mappings[0]["variants"], json({1}));
    EXPECT_EQ(mappings[1]["variants"], json({2}));
  }
}

TEST_F(Model, LooksAreVariants) {
  const std::filesystem::path later = folder_.path() / "later";
  std::filesystem::create_directories(later / "textures");
  Image blue;
  blue.width_px = 40;
  blue.height_px = 30;
  blue.data.assign(3600, 20);
  for (size_t i = 2; i < blue.data.size(); i += 3) blue.data[i] = 230;
  WriteImage(blue, later / "textures/B0001_W01.png");
  TextureSet others = textures_;
  others.facets[1] = others.facets[0];
  others.facets[1].id = "B0001/W02";
  const std::vector<ModelLook> looks = {{kOwnLook, textures_, folder_.path()},
                                        {"later", others, later}};
  WriteFile(folder_.path() / "model.glb", GlbOfLooks(proxy_, looks, {64, 90}));
  const json gltf = GlbJson();
  EXPECT_EQ(gltf["extensionsUsed"], json({"KHR_materials_unlit", "KHR_materials_variants"}));
  EXPECT_EQ(gltf["extensions"]["KHR_materials_variants"]["variants"],
            json::parse(R"([{"name":"survey"},{"name":"later"}])"));
  const auto name_of = [&](const json& material) {
    return gltf["materials"][material.get<int>()]["name"].get<std::string>();
  };
  const char* const names[][2] = {{"B0001/W01", "B0001/W01 later"},
                                  {"untextured", "B0001/W02 later"}};
  for (int i = 0; i < 2; ++i) {
    const json& primitive = gltf["meshes"][i]["primitives"][0];
    EXPECT_EQ(name_of(primitive["material"]), names[i][0]);
    EXPECT_TRUE(primitive["attributes"].contains("TEXCOORD_0"));
    const json& mappings = primitive["extensions"]["KHR_materials_variants"]["mappings"];
    ASSERT_EQ(mappings.size(), 1u);
    EXPECT_EQ(mappings[0]["variants"], json({1}));
    EXPECT_EQ(name_of(mappings[0]["material"]), names[i][1]);
  }
  const auto findings = test::KhronosFindings(folder_.path() / "model.glb");
  if (!findings) GTEST_SKIP() << "the Khronos validator is not installed";
  EXPECT_EQ(*findings, "");
}

// What looks otherwise on a later day keeps a picture of its own; what was seen only then shares
// one.
TEST_F(Model, LooksDoNotShareTheirAtlases) {
  TextureSet others = textures_;
  others.facets[1] = others.facets[0];
  others.facets[1].id = "B0001/W02";
  const std::vector<ModelLook> looks = {{kOwnLook, textures_, folder_.path()},
                                        {"later", others, folder_.path()}};
  GlbOptions options;
  options.atlas_px = 128;
  WriteFile(folder_.path() / "model.glb", GlbOfLooks(proxy_, looks, options));
  const json gltf = GlbJson();
  std::vector<std::string> names;
  for (const json& material : gltf["materials"]) names.push_back(material["name"]);
  EXPECT_EQ(names,
            (std::vector<std::string>{"untextured", "B0001/W01", "B0001/W01 later", "atlas 1"}));
  const json& behind = gltf["meshes"][1]["primitives"][0];
  EXPECT_EQ(behind["material"], 0);
  EXPECT_EQ(behind["extensions"]["KHR_materials_variants"]["mappings"][0]["material"], 3);
}

TEST_F(Model, OneLookHasNoVariants) {
  WriteGlb(proxy_, textures_, folder_.path(), {64, 90});
  EXPECT_EQ(GlbJson()["extensionsUsed"], json({"KHR_materials_unlit"}));
  EXPECT_FALSE(GlbJson().contains("extensions"));
}

TEST_F(Model, HasReliefWhereItIsAskedFor) {
  Relief relief;
  relief.cell = 0.5;
  relief.width = 8;
  relief.height = 6;
  relief.step = 0.1;
  relief.highest = 0.6;
  relief.heights.assign(48, 0);
  relief.heights[17] = 0.6f;
  const ReliefFiles files = EncodeRelief(relief);
  std::filesystem::create_directories(folder_.path() / kReliefFolder);
  WriteFile(folder_.path() / kReliefFolder / "B0001_W01.png", files.png);
  WriteFile(folder_.path() / kReliefFolder / "B0001_W01.json", files.json);
  const auto deepest = [&] {  // of the first wall, towards the viewer
    return GlbJson()["accessors"][0]["max"][2].get<double>();
  };
  GlbOptions options;
  WriteGlb(proxy_, textures_, folder_.path(), options);
  EXPECT_NEAR(deepest(), 0, 1e-6);
  options.relief = true;
  WriteGlb(proxy_, textures_, folder_.path(), options);
  EXPECT_NEAR(deepest(), 0.6, 1e-5);
  if (const auto findings = test::KhronosFindings(folder_.path() / "model.glb")) {
    EXPECT_EQ(*findings, "");
  }
}

TEST_F(Model, WithoutPicturesIsStillWritten) {
  WriteGlb(proxy_, {}, folder_.path(), {64, 90});
  WriteObj(proxy_, {}, folder_.path());
  EXPECT_FALSE(GlbJson().contains("images"));
}

TEST_F(Model, IntoAMissingFolderIsAnError) {
  EXPECT_THROW(WriteObj(proxy_, {}, folder_.path() / "missing"), Error);
}

TEST_F(Model, WorldFileGivesHeightsOnWallsAndMapCoordinatesOnLevelRoofs) {
  EXPECT_EQ(WorldFile(textures_.facets[0], proxy_.buildings[0].facets[0], proxy_),
            "0.1\n0\n0\n-0.1\n0.05\n2.95\n");
  Facet roof;
  roof.normal = Eigen::Vector3d::UnitZ();
  TexturedFacet texture = textures_.facets[0];
  texture.origin = {10, 20, 5};
  texture.v_axis = -Eigen::Vector3d::UnitY();
  EXPECT_EQ(WorldFile(texture, roof, proxy_), "0.1\n0\n0\n-0.1\n10.05\n19.95\n");
}

TEST_F(Model, OrthophotoJsonHoldsScaleAndPlane) {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.origin_latitude_deg = 52.5;
  const json j = json::parse(
      OrthophotoJson(textures_.facets[0], proxy_.buildings[0].facets[0], proxy_, georef));
  EXPECT_EQ(j.at("version"), 1);
  EXPECT_EQ(j.at("metres_per_pixel"), 0.1);
  EXPECT_EQ(j.at("plane").at("normal").at(1), -1.0);
  EXPECT_EQ(j.at("origin").at(2), 3.0);
  EXPECT_EQ(j.at("frame").at("origin").at("latitude_deg"), 52.5);
  EXPECT_EQ(j.at("unit"), "metre");
}

}  // namespace
}  // namespace stucco
