// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <filesystem>
#include <functional>
#include <string>

#include "simulate/scene/scene_folder.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/simulate/scenes.h"

namespace stucco::simulate {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

class ReadSceneTest : public ::testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::path(::testing::TempDir()) /
              ::testing::UnitTest::GetInstance()->current_test_info()->name();
    std::filesystem::remove_all(folder_);
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }

  std::filesystem::path Write(const std::string& name, const std::string& text) {
    WriteFile(folder_ / name, text);
    return folder_ / name;
  }
  // A wall 4 wide and 3 high with a picture, y up, facing z (south).
  std::filesystem::path WriteObj(const std::string& vertices = kWall) {
    Write("wall.mtl", "newmtl brick\nKd 0 0 0\nmap_Kd brick.png\n");
    return Write("wall.obj", "mtllib wall.mtl\n" + vertices +
                                 "vt 0 1\nvt 0 0\nvt 1 0\nvt 1 1\no house/F00\nusemtl brick\n"
                                 "f 1/1 2/2 3/3 4/4\n");
  }
  void WritePicture() { WriteImage(test::Checkerboard(2, 1, 4), folder_ / "brick.png"); }

  static constexpr char kWall[] = "v 0 3 0\nv 0 0 0\nv 4 0 0\nv 4 3 0\n";
  std::filesystem::path folder_;
};

std::string WhatRefuses(const std::filesystem::path& path, const ModelReading& reading = {}) {
  try {
    ReadScene(path, reading);
  } catch (const Error& error) {
    return std::string(error.what()) + " | " + error.remedy();
  }
  return "accepted";
}

TEST_F(ReadSceneTest, HashTellsAllThatPicturesDependOn) {
  WritePicture();
  const Scene scene = ReadScene(WriteObj());
  const std::string hash = HashScene(scene);
  EXPECT_EQ(HashScene(ReadScene(folder_ / "wall.obj")), hash);
  const auto changes = [&](const std::function<void(Scene&)>& change) {
    Scene other = scene;
    change(other);
    return HashScene(other) != hash;
  };
  EXPECT_TRUE(changes([](Scene& s) { s.positions[0].x() += 1e-3f; }));
  EXPECT_TRUE(changes([](Scene& s) { s.uv[1].y() += 1e-3f; }));
  EXPECT_TRUE(changes([](Scene& s) { std::swap(s.triangles[0], s.triangles[1]); }));
  EXPECT_TRUE(changes([](Scene& s) { s.materials[0].gloss += 0.1f; }));
  EXPECT_TRUE(changes([](Scene& s) { s.textures[0].data.back() ^= 1; }));
  EXPECT_TRUE(changes([](Scene& s) { s.elements[0] += "a"; }));
  // A picture beside the model is part of the scene.
  WriteImage(test::Checkerboard(2, 1, 5), folder_ / "brick.png");
  EXPECT_NE(HashScene(ReadScene(folder_ / "wall.obj")), hash);
}

TEST_F(ReadSceneTest, TakesObjWithItsPicture) {
  WritePicture();
  const Scene scene = ReadScene(WriteObj());
  ASSERT_EQ(scene.triangles.size(), 2u);
  EXPECT_THAT(scene.elements, ElementsAre("house/F00"));
  ASSERT_EQ(scene.textures.size(), 1u);
  EXPECT_EQ(scene.textures[0].width_px, 8);
  const Material& material = scene.materials[scene.materials_of[0]];
  EXPECT_EQ(material.texture, 0);
  EXPECT_TRUE(material.colour.isOnes());  // Kd 0 beside a picture means nothing
  EXPECT_FALSE(material.cut_out);
  for (size_t i = 0; i < scene.positions.size(); ++i) {
    const Eigen::Vector3f& p = scene.positions[i];  // x east, z up; the wall is at y = 0
    EXPECT_EQ(p.y(), 0);
    EXPECT_EQ(scene.uv[i].x(), p.x() / 4);
    EXPECT_EQ(scene.uv[i].y(), 1 - p.z() / 3);  // v = 0 is the top of the picture
  }
  const auto at = [&](int k) { return scene.positions[scene.triangles[0][k]]; };
  EXPECT_LT((at(1) - at(0)).cross(at(2) - at(0)).normalized().y(), -0.99f);  // faces south
}

TEST_F(ReadSceneTest, TurnsAndScalesAsTold) {
  WritePicture();
  const Scene scene = ReadScene(WriteObj(), {UpAxis::kZ, 2});
  float highest = 0, northmost = 0;
  for (const Eigen::Vector3f& p : scene.positions) {
    highest = std::max(highest, p.z());
    northmost = std::max(northmost, p.y());
  }
  EXPECT_EQ(highest, 0);
  EXPECT_EQ(northmost, 6);
}

// Two nodes with one mesh, the second moved and mirrored; materials with alpha and roughness.
TEST_F(ReadSceneTest, TakesGltfNodes) {
  // Positions (0,0,0) (1,0,0) (0,2,0) and the indices 0 1 2 as bytes.
  const std::string buffer =
      "data:application/octet-stream;base64,"
      "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAAEAAAAAAAAECAA==";
  const auto path = Write("two.gltf", R"({"asset":{"version":"2.0"},"scene":0,
    "scenes":[{"nodes":[0,1]}],
    "nodes":[{"name":"B0001/F00","mesh":0},
             {"name":"tree","mesh":1,"translation":[10,0,0],"scale":[-1,1,1]}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":0}]},
              {"primitives":[{"attributes":{"POSITION":0},"indices":1,"material":1}]}],
    "materials":[{"name":"pane","pbrMetallicRoughness":
                    {"baseColorFactor":[0.5,0.25,0.125,1],"roughnessFactor":0.1}},
                 {"name":"leaf","alphaMode":"MASK"}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                  "min":[0,0,0],"max":[1,2,0]},
                 {"bufferView":1,"componentType":5121,"count":3,"type":"SCALAR"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},
                   {"buffer":0,"byteOffset":36,"byteLength":3}],
    "buffers":[{"byteLength":40,"uri":")" +
                                          buffer + R"("}]})");
  const Scene scene = ReadScene(path);
  EXPECT_THAT(scene.elements, ElementsAre("B0001/F00", "tree"));
  ASSERT_EQ(scene.triangles.size(), 2u);
  const Material& pane = scene.materials[scene.materials_of[0]];
  EXPECT_NEAR((pane.colour - Eigen::Vector3f(0.5f, 0.25f, 0.125f)).norm(), 0, 1e-6);
  EXPECT_NEAR(pane.gloss, 0.9, 1e-6);
  // Without a picture there is nothing to cut out.
  EXPECT_FALSE(scene.materials[scene.materials_of[1]].cut_out);
  float least = 100;
  for (const int vertex : scene.triangles[1]) least = std::min(least, scene.positions[vertex].x());
  EXPECT_EQ(least, 9);
  for (int i = 0; i < 2; ++i) {  // the mirrored one still faces the same way
    const auto at = [&](int k) { return scene.positions[scene.triangles[i][k]]; };
    EXPECT_LT((at(1) - at(0)).cross(at(2) - at(0)).y(), 0);
  }
}

// A triangle with two sets of texture coordinates; `texture` goes on where its picture is named.
std::string GltfWithPicture(const std::string& picture, const std::string& texture,
                            const std::string& attributes) {
  return R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],
    "extensionsUsed":["KHR_texture_transform"],
    "nodes":[{"name":"wall","mesh":0}],
    "meshes":[{"primitives":[{"attributes":{"POSITION":0)" +
         attributes + R"(},"material":0}]}],
    "materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0)" +
         texture + R"(}}}],
    "textures":[{"source":0}],"images":[{"uri":")" +
         picture + R"("}],
    "accessors":[{"bufferView":0,"componentType":5126,"count":3,"type":"VEC3",
                  "min":[0,0,0],"max":[1,2,0]},
                 {"bufferView":1,"componentType":5126,"count":3,"type":"VEC2"},
                 {"bufferView":2,"componentType":5126,"count":3,"type":"VEC2"}],
    "bufferViews":[{"buffer":0,"byteOffset":0,"byteLength":36},
                   {"buffer":0,"byteOffset":36,"byteLength":24},
                   {"buffer":0,"byteOffset":60,"byteLength":24}],
    "buffers":[{"byteLength":84,"uri":"triangle.bin"}]})";
}

std::string TriangleBytes() {
  const std::array<float, 21> numbers = {0,    0,    0,     1,    0,    0,    0, 2, 0,  // places
                                         0,    0,    1,     0,    0,    1,       // the first set
                                         0.5f, 0.5f, 0.75f, 0.5f, 0.5f, 0.75f};  // the second
  return {reinterpret_cast<const char*>(numbers.data()), sizeof numbers};
}

TEST_F(ReadSceneTest, TakesTheTextureCoordinatesThatAGltfMeans) {
  WritePicture();
  Write("triangle.bin", TriangleBytes());
  const auto uv_with = [&](const std::string& texture) {
    const std::string both = R"(,"TEXCOORD_0":1,"TEXCOORD_1":2)";
    return ReadScene(Write("a.gltf", GltfWithPicture("brick.png", texture, both))).uv;
  };
  const auto near = [](float u, float v) {
    return ::testing::Truly(
        [=](const Eigen::Vector2f& uv) { return (uv - Eigen::Vector2f(u, v)).norm() < 1e-5f; });
  };
  EXPECT_THAT(uv_with(""), ElementsAre(near(0, 0), near(1, 0), near(0, 1)));
  EXPECT_THAT(uv_with(R"(,"texCoord":1)"),
              ElementsAre(near(0.5f, 0.5f), near(0.75f, 0.5f), near(0.5f, 0.75f)));
  const std::string moved =
      R"(,"extensions":{"KHR_texture_transform":{"offset":[0.1,0.2],"scale":[2,4]}})";
  EXPECT_THAT(uv_with(moved), ElementsAre(near(0.1f, 0.2f), near(2.1f, 0.2f), near(0.1f, 4.2f)));
  // A quarter turn, counter-clockwise, after scaling and before moving.
  const std::string turned = R"(,"extensions":{"KHR_texture_transform":
    {"offset":[0.1,0.2],"rotation":1.5707963,"scale":[2,4]}})";
  EXPECT_THAT(uv_with(turned), ElementsAre(near(0.1f, 0.2f), near(0.1f, -1.8f), near(4.1f, 0.2f)));
  EXPECT_THAT(uv_with(R"(,"texCoord":1)" + moved),
              ElementsAre(near(1.1f, 2.2f), near(1.6f, 2.2f), near(1.1f, 3.2f)));
}

TEST_F(ReadSceneTest, PicturesWithoutTextureCoordinatesAreRefused) {
  WritePicture();
  Write("triangle.bin", TriangleBytes());
  const auto path = Write("a.gltf", GltfWithPicture("brick.png", "", ""));
  EXPECT_THAT(WhatRefuses(path), HasSubstr("part wall has the picture"));
  EXPECT_THAT(WhatRefuses(path), HasSubstr("brick.png"));
}

TEST_F(ReadSceneTest, NamesOfPicturesMayBeUris) {
  WritePicture();
  Write("triangle.bin", TriangleBytes());
  const auto read = [&](const std::string& uri) {
    return WhatRefuses(Write("a.gltf", GltfWithPicture(uri, "", R"(,"TEXCOORD_0":1)")));
  };
  std::filesystem::rename(folder_ / "brick.png", folder_ / "brick wall.png");
  EXPECT_EQ(read("brick%20wall.png"), "accepted");
  EXPECT_THAT(read("brick%wall.png"), HasSubstr("brick%wall.png is missing"));
  // A name that is so is taken before what it would mean.
  std::filesystem::rename(folder_ / "brick wall.png", folder_ / "brick%20wall.png");
  EXPECT_EQ(read("brick%20wall.png"), "accepted");
}

TEST_F(ReadSceneTest, NamesWhatIsMissing) {
  EXPECT_THAT(WhatRefuses(folder_ / "nowhere.glb"), HasSubstr("no such scene"));
  EXPECT_THAT(WhatRefuses(folder_), HasSubstr("there is no scene.glb in it"));
  EXPECT_THAT(WhatRefuses(WriteObj()), HasSubstr("brick.png is missing"));
  WriteObj();
  std::filesystem::rename(folder_ / "wall.mtl", folder_ / "other.mtl");
  EXPECT_THAT(WhatRefuses(folder_ / "wall.obj"), HasSubstr("wall.mtl are missing"));
  EXPECT_THAT(WhatRefuses(Write("text.glb", "hello")), HasSubstr("cannot be read as a model"));
  EXPECT_THAT(WhatRefuses(Write("dots.obj", "v 0 0 0\nv 5 0 0\nv 0 5 0\n")), HasSubstr("dots.obj"));
}

TEST_F(ReadSceneTest, NamesADamagedPicture) {
  Write("brick.png", "\x89PNG but no more");
  EXPECT_THAT(WhatRefuses(WriteObj()), HasSubstr("brick.png"));
  WritePicture();
  const std::string whole = ReadFile(folder_ / "brick.png");
  Write("brick.png", whole.substr(0, whole.size() / 2));
  EXPECT_THAT(WhatRefuses(WriteObj()), HasSubstr("brick.png"));
}

TEST_F(ReadSceneTest, AsksForTheUnitOfGiantsAndDwarfs) {
  WritePicture();
  EXPECT_THAT(WhatRefuses(WriteObj("v 0 30000 0\nv 0 0 0\nv 40000 0 0\nv 40000 30000 0\n")),
              HasSubstr("--unit 0.001"));
  EXPECT_THAT(WhatRefuses(WriteObj("v 0 0.3 0\nv 0 0 0\nv 0.4 0 0\nv 0.4 0.3 0\n")),
              HasSubstr("--unit 1000"));
  EXPECT_EQ(ReadScene(WriteObj("v 0 30000 0\nv 0 0 0\nv 40000 0 0\nv 40000 30000 0\n"),
                      {UpAxis::kByFormat, 0.001})
                .triangles.size(),
            2u);
  EXPECT_THAT(WhatRefuses(WriteObj(), {UpAxis::kByFormat, 0}), HasSubstr("makes no sense"));
}

TEST_F(ReadSceneTest, RefusesMapCoordinates) {
  WritePicture();
  const std::string far =
      WhatRefuses(WriteObj("v 458000 3 0\nv 458000 0 0\nv 458004 0 0\nv 458004 3 0\n"));
  EXPECT_THAT(far, HasSubstr("458004 m from its origin"));
  EXPECT_THAT(far, HasSubstr("take about (458002"));
}

TEST_F(ReadSceneTest, RefusesWhatIsNotFinite) {
  WritePicture();
  EXPECT_NE(WhatRefuses(WriteObj("v nan 3 0\nv 0 0 0\nv 4 0 0\nv 4 3 0\n")), "accepted");
}

}  // namespace
}  // namespace stucco::simulate
