// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/read_surfaces.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/glb.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using testing::ElementsAre;
using testing::HasSubstr;

std::filesystem::path Write(const std::string& name, const std::string& text) {
  auto path = std::filesystem::path(testing::TempDir()) / name;
  WriteFile(path, text);
  return path;
}

std::string Refusal(const std::filesystem::path& path) {
  try {
    ReadSurfaceModel(path, UpAxis::kOfFormat);
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    return error.what();
  }
  return "was not refused";
}

constexpr char kSquare[] = "v 0 0 5\nv 2 0 5\nv 2 3 5\nv 0 3 5\nl 1 2\nf 1 2 3 4\n";

TEST(ReadSurfaces, KnowsModelsByNameOrContents) {
  EXPECT_TRUE(IsSurfaceModel(Write("surfaces.obj", kSquare)));
  EXPECT_TRUE(IsSurfaceModel(Write("surfaces.GLB", "")));
  EXPECT_TRUE(IsSurfaceModel(Write("surfaces.json", R"({"type": "CityJSON"})")));
  EXPECT_FALSE(IsSurfaceModel(Write("reconstruction.json", "[]")));
  EXPECT_FALSE(IsSurfaceModel(testing::TempDir()));
  EXPECT_FALSE(IsSurfaceModel(std::filesystem::path(testing::TempDir()) / "gone.obj"));
}

TEST(ReadSurfaces, ObjHasZUpUnlessSaid) {
  const auto path = Write("square.obj", kSquare);
  const SurfaceModel model = ReadSurfaceModel(path, UpAxis::kOfFormat);
  EXPECT_TRUE(model.is_mesh);
  ASSERT_EQ(model.objects.size(), 1u);
  ASSERT_EQ(model.objects[0].polygons.size(), 2u);  // triangles, without the line
  for (const SurfacePolygon& polygon : model.objects[0].polygons) {
    for (const Vector3d& corner : polygon.rings.front()) EXPECT_EQ(corner.z(), 5);
  }
  const SurfaceModel turned = ReadSurfaceModel(path, UpAxis::kY);
  for (const SurfacePolygon& polygon : turned.objects[0].polygons) {
    for (const Vector3d& corner : polygon.rings.front()) EXPECT_EQ(corner.y(), -5);
  }
}

TEST(ReadSurfaces, GlbHasYUp) {
  GlbPrimitive primitive;
  primitive.positions = {{1, 7, -2}, {4, 7, -2}, {1, 7, -6}};
  primitive.indices = {0, 1, 2};
  GlbModel glb;
  glb.materials.emplace_back();
  glb.meshes.push_back({"roof", {primitive}});
  const SurfaceModel model = ReadSurfaceModel(Write("roof.glb", GlbBytes(glb)), UpAxis::kOfFormat);
  ASSERT_EQ(model.objects[0].polygons.size(), 1u);
  EXPECT_THAT(model.objects[0].polygons[0].rings.front(),
              ElementsAre(Vector3d(1, 2, 7), Vector3d(4, 2, 7), Vector3d(1, 6, 7)));
}

TEST(ReadSurfaces, PartsBelongToTheirBuildingAndTreesToNone) {
  const auto path = Write("town.city.json", R"({"type": "CityJSON", "version": "2.0",
    "vertices": [[0, 0, 0], [4, 0, 0], [0, 4, 0], [0, 0, 4]], "CityObjects": {
      "a": {"type": "Building", "children": ["a-1", "a-2"]},
      "a-1": {"type": "BuildingPart", "parents": ["a"], "geometry": [{"type": "MultiSurface",
        "lod": "2", "boundaries": [[[0, 1, 3]]], "semantics": {"surfaces": [
        {"type": "WallSurface", "id": "a/W00"}], "values": [0]}}]},
      "a-2": {"type": "BuildingPart", "parents": ["a"], "geometry": [{"type": "MultiSurface",
        "lod": "2", "boundaries": [[[1, 2, 3]]]}]},
      "tree": {"type": "SolitaryVegetationObject", "geometry": [{"type": "MultiSurface",
        "lod": "2", "boundaries": [[[1, 2, 3]]]}]},
      "field": {"type": "LandUse", "geometry": [{"type": "MultiSurface", "lod": "2",
        "boundaries": [[[0, 1, 2]]]}]}}})");
  const SurfaceModel model = ReadSurfaceModel(path, UpAxis::kOfFormat);
  EXPECT_FALSE(model.is_mesh);
  ASSERT_EQ(model.objects.size(), 2u);
  EXPECT_EQ(model.objects[0].id, "a");
  ASSERT_EQ(model.objects[0].polygons.size(), 2u);
  EXPECT_EQ(model.objects[0].polygons[0].facet_class, FacetClass::kWall);
  EXPECT_EQ(model.objects[0].polygons[0].id, "a/W00");
  EXPECT_EQ(model.objects[0].polygons[1].facet_class, std::nullopt);
  EXPECT_TRUE(model.objects[1].is_ground);
  EXPECT_EQ(model.objects[1].polygons[0].facet_class, FacetClass::kGround);
  EXPECT_THAT(model.notes, ElementsAre("1 objects of type SolitaryVegetationObject are left out"));
}

TEST(ReadSurfaces, RefusesWhatIsEmptyDamagedOrFarFromItsOrigin) {
  EXPECT_THAT(Refusal(Write("far.obj", "v 500000 0 5\nv 500002 0 5\nv 500002 3 5\nf 1 2 3\n")),
              HasSubstr("far.obj: reaches 500002 units from its origin"));
  EXPECT_THAT(Refusal(Write("broken.glb", "glTF")), HasSubstr("broken.glb: cannot be read"));
  EXPECT_THAT(Refusal(Write("empty.city.json", R"({"type": "CityJSON", "version": "2.0",
      "vertices": [], "CityObjects": {}})")),
              HasSubstr("has no surfaces"));
  EXPECT_THAT(Refusal(Write("points.obj", "v 0 0 5\nv 2 0 5\nl 1 2\n")),
              testing::AnyOf(HasSubstr("has no surfaces"), HasSubstr("cannot be read")));
}

}  // namespace
}  // namespace stucco
