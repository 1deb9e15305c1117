// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/glb.h"

#include <gtest/gtest.h>

#include <cstring>
#include <nlohmann/json.hpp>

namespace stucco {
namespace {

using nlohmann::json;

uint32_t Word(const std::string& bytes, size_t at) {
  uint32_t word = 0;
  std::memcpy(&word, &bytes[at], sizeof(word));
  return word;
}

json JsonOf(const std::string& glb) {
  return json::parse(glb.substr(20, Word(glb, 12)));
}

// A triangle with everything that a primitive may have.
GlbModel Triangle() {
  GlbModel model;
  model.materials.push_back({.name = "wall", .texture = 0});
  model.textures.push_back({"12345", "image/jpeg"});
  GlbPrimitive primitive;
  primitive.positions = {{0, -1, 0}, {4, 0, 0}, {0, 3, 2}};
  primitive.normals.assign(3, {0, 0, 1});
  primitive.uv = {{0, 1}, {1, 1}, {0, 0}};
  primitive.indices = {0, 1, 2};
  model.meshes.push_back({"B0001/W00", {primitive}});
  return model;
}

TEST(GlbBytes, HoldsChunksThatFillTheFileAndViewsThatAreAligned) {
  const std::string glb = GlbBytes(Triangle());
  EXPECT_EQ(glb.substr(0, 4), "glTF");
  EXPECT_EQ(Word(glb, 8), glb.size());
  const size_t text = Word(glb, 12);
  EXPECT_EQ(28 + text + Word(glb, 20 + text), glb.size());
  const json gltf = JsonOf(glb);
  for (const json& view : gltf.at("bufferViews"))
    EXPECT_EQ(view.at("byteOffset").get<int>() % 4, 0);
  const json& attributes = gltf["meshes"][0]["primitives"][0].at("attributes");
  const json& positions = gltf["accessors"][attributes.at("POSITION").get<int>()];
  EXPECT_EQ(positions.at("min"), json({0.0, -1.0, 0.0}));
  EXPECT_EQ(positions.at("max"), json({4.0, 3.0, 2.0}));
  EXPECT_EQ(gltf["accessors"][attributes.at("NORMAL").get<int>()].at("count"), 3);
  const json& picture = gltf["bufferViews"][gltf["images"][0].at("bufferView").get<int>()];
  EXPECT_EQ(glb.substr(28 + text + picture.at("byteOffset").get<size_t>(), 5), "12345");
}

TEST(GlbBytes, LeavesOutWhatThereIsNotAndNamesTheExtension) {
  GlbModel model = Triangle();
  json gltf = JsonOf(GlbBytes(model));
  EXPECT_FALSE(gltf.contains("extensionsUsed"));
  EXPECT_FALSE(gltf["asset"].contains("extras"));
  EXPECT_EQ(gltf["samplers"][0].at("wrapS"), 10497);

  model.textures.clear();
  model.materials[0] = {.name = "plain", .unlit = true, .two_sided = false};
  model.meshes[0].primitives[0].normals.clear();
  model.meshes[0].primitives[0].uv.clear();
  model.offset = {389000, 5819000, 0};
  gltf = JsonOf(GlbBytes(model));
  EXPECT_EQ(gltf.at("extensionsUsed"), json({"KHR_materials_unlit"}));
  EXPECT_TRUE(gltf["materials"][0].at("extensions").contains("KHR_materials_unlit"));
  EXPECT_EQ(gltf["materials"][0].at("doubleSided"), false);
  EXPECT_EQ(gltf["asset"].at("extras").at("offset"), json({389000.0, 5819000.0, 0.0}));
  EXPECT_FALSE(gltf.contains("images"));
  EXPECT_EQ(gltf["meshes"][0]["primitives"][0].at("attributes").size(), 1u);
}

TEST(GlbBytesDeathTest, RequiresIndicesThatLeadSomewhere) {
  GlbModel model = Triangle();
  model.meshes[0].primitives[0].indices[1] = 3;
  EXPECT_DEATH(GlbBytes(model), "IsSound");
}

}  // namespace
}  // namespace stucco
