// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <gtest/gtest.h>

#include <assimp/Importer.hpp>
#include <cstring>
#include <nlohmann/json.hpp>

#include "simulate/scene/scene_folder.h"
#include "survey/files.h"
#include "tests/survey/support.h"

namespace stucco::simulate {
namespace {

using Json = nlohmann::json;

// Two elements: a quad with a picture, and a triangle with alpha.
Scene SmallScene() {
  Scene scene;
  scene.positions = {{0, 0, 0}, {4, 0, 0}, {4, 0, 3}, {0, 0, 3}, {1, 2, 5}};
  scene.uv = {{0, 1}, {1, 1}, {1, 0}, {0, 0}, {0.25f, 0.5f}};
  scene.triangles = {{0, 1, 2}, {0, 2, 3}, {1, 4, 2}};
  scene.materials_of = {0, 0, 1};
  scene.elements_of = {0, 0, 1};
  scene.materials = {{.name = "wall", .texture = 0},
                     {.name = "leaf", .texture = 1, .cut_out = true, .gloss = 0.25f}};
  scene.elements = {"B0001/F00", "occluder/tree-000"};
  scene.textures.push_back({5, 3, 3, std::vector<uint8_t>(45, 200)});
  scene.textures.push_back({2, 2, 4, std::vector<uint8_t>(16, 77)});
  return scene;
}

uint32_t Word(const std::string& bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, bytes.data() + at, sizeof(word));
  return word;
}

TEST(WriteGlb, ChunksAndViewsAreAlignedAndInside) {
  const test::TemporaryFolder folder;
  WriteGlb(SmallScene(), folder / "scene.glb");
  const std::string glb = ReadFile(folder / "scene.glb");
  ASSERT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(Word(glb, 4), 2u);
  EXPECT_EQ(Word(glb, 8), glb.size());
  const size_t text = Word(glb, 12);
  EXPECT_EQ(text % 4, 0u);
  const size_t binary = Word(glb, 20 + text);
  EXPECT_EQ(binary % 4, 0u);
  EXPECT_EQ(28 + text + binary, glb.size());
  const Json json = Json::parse(glb.substr(20, text));
  EXPECT_EQ(json["buffers"][0]["byteLength"], binary);
  for (const Json& view : json["bufferViews"]) {
    EXPECT_EQ(view["byteOffset"].get<size_t>() % 4, 0u);
    EXPECT_LE(view["byteOffset"].get<size_t>() + view["byteLength"].get<size_t>(), binary);
  }
  for (const Json& mesh : json["meshes"]) {
    const size_t positions = mesh["primitives"][0]["attributes"]["POSITION"];
    EXPECT_EQ(json["accessors"][positions]["min"].size(), 3u);
    EXPECT_EQ(json["accessors"][positions]["max"].size(), 3u);
  }
  EXPECT_EQ(json["images"][0]["mimeType"], "image/jpeg");
  EXPECT_EQ(json["images"][1]["mimeType"], "image/png");
  EXPECT_EQ(json["materials"][1]["alphaMode"], "MASK");
  EXPECT_FLOAT_EQ(json["materials"][1]["pbrMetallicRoughness"]["roughnessFactor"], 0.75f);
}

TEST(WriteGlb, AssimpReadsEveryElementYUp) {
  const test::TemporaryFolder folder;
  WriteGlb(SmallScene(), folder / "scene.glb");
  Assimp::Importer importer;
  const aiScene* scene = importer.ReadFile((folder / "scene.glb").string(), 0);
  ASSERT_NE(scene, nullptr) << importer.GetErrorString();
  ASSERT_EQ(scene->mNumMeshes, 2u);
  EXPECT_EQ(scene->mNumTextures, 2u);
  EXPECT_STREQ(scene->mRootNode->mChildren[1]->mName.C_Str(), "occluder/tree-000");
  EXPECT_EQ(scene->mMeshes[0]->mNumFaces, 2u);
  const aiVector3D corner = scene->mMeshes[1]->mVertices[1];
  EXPECT_FLOAT_EQ(corner.x, 1);
  EXPECT_FLOAT_EQ(corner.y, 5);
  EXPECT_FLOAT_EQ(corner.z, -2);
  // Assimp counts v from below.
  EXPECT_FLOAT_EQ(scene->mMeshes[1]->mTextureCoords[0][1].y, 1 - 0.5f);
}

TEST(WriteGlb, SceneWithoutPicturesHasNoEmptyLists) {
  const test::TemporaryFolder folder;
  Scene scene = SmallScene();
  scene.textures.clear();
  for (Material& material : scene.materials) material.texture = -1;
  WriteGlb(scene, folder / "scene.glb");
  const std::string glb = ReadFile(folder / "scene.glb");
  const Json json = Json::parse(glb.substr(20, Word(glb, 12)));
  EXPECT_FALSE(json.contains("images"));
  EXPECT_FALSE(json.contains("textures"));
}

TEST(WriteGlb, UnwritablePlaceIsAnError) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(WriteGlb(SmallScene(), folder / "missing" / "scene.glb"), Error);
}

SceneInfo SomeInfo() {
  SceneInfo info;
  info.style = "block";
  info.seed = 0xffffffffffffffffu;
  info.georef.frame = "enu";
  info.georef.origin_latitude_deg = 50.0875;
  info.georef.origin_longitude_deg = -14.1234567890123;
  info.georef.origin_height_m = 203.25;
  info.has_truth = true;
  return info;
}

TEST(SceneInfo, ReadsBackWhatWasWritten) {
  const test::TemporaryFolder folder;
  WriteSceneInfo(SomeInfo(), folder.path());
  const SceneInfo info = ReadSceneInfo(folder.path());
  EXPECT_EQ(info.style, "block");
  EXPECT_EQ(info.seed, 0xffffffffffffffffu);
  EXPECT_EQ(info.georef.frame, "enu");
  EXPECT_EQ(info.georef.origin_longitude_deg, -14.1234567890123);
  EXPECT_TRUE(info.georef.metric);
  EXPECT_TRUE(info.has_truth);
  EXPECT_FALSE(info.has_terrain);
}

TEST(SceneInfo, OfAModelIsArbitrary) {
  const test::TemporaryFolder folder;
  WriteFile(folder / "town.obj", "v 0 0 0\n");
  const SceneInfo info = ReadSceneInfo(folder / "town.obj");
  EXPECT_EQ(info.georef.frame, "arbitrary");
  EXPECT_FALSE(info.has_truth);
}

TEST(SceneInfo, BadFilesAreErrorsThatNameThem) {
  const test::TemporaryFolder folder;
  const auto message = [&] {
    const Error error = test::ErrorOf([&] { ReadSceneInfo(folder.path()); });
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return std::string(error.what());
  };
  EXPECT_NE(message().find("no scene folder"), std::string::npos);
  WriteFile(folder / kSceneFile, "{\"version\":1");
  EXPECT_NE(message().find(kSceneFile), std::string::npos);
  WriteFile(folder / kSceneFile, "{\"version\":99}");
  EXPECT_NE(message().find("version 99"), std::string::npos);
  WriteFile(folder / kSceneFile, "{\"version\":1,\"style\":3}");
  EXPECT_NE(message().find(kSceneFile), std::string::npos);
  EXPECT_THROW(ReadSceneInfo(folder / "nothing"), Error);
}

}  // namespace
}  // namespace stucco::simulate
