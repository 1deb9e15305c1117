// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "proxy/export_cityjson.h"
#include "proxy/export_obj.h"
#include "proxy/triangulate.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

Facet Square(const std::string& id, FacetClass facet_class, const Vector3d& origin,
             const Vector3d& u, const Vector3d& v) {
  Facet facet;
  facet.id = facet.facade = id;
  facet.facet_class = facet_class;
  facet.normal = u.cross(v).normalized();
  facet.offset = facet.normal.dot(origin);
  facet.outer = {origin, origin + u, origin + u + v, origin + v};
  facet.area = u.norm() * v.norm();
  facet.seen = 0.75;
  return facet;
}

Proxy Model(bool watertight) {
  Proxy proxy;
  proxy.metric = true;
  const Vector3d x = 4 * Vector3d::UnitX(), z = 3 * Vector3d::UnitZ(), y = 5 * Vector3d::UnitY();
  Building building{.id = "B0001", .watertight = watertight, .source = "cloud", .facets = {}};
  building.facets = {Square("B0001/W00", FacetClass::kWall, {100, 0, 0}, x, z),
                     Square("B0001/R0", FacetClass::kRoof, {100, 0, 3}, x, y)};
  building.facets[0].holes = {{{101, 0, 1}, {101, 0, 2}, {102, 0, 2}, {102, 0, 1}}};
  proxy.buildings = {building,
                     {.id = "G0",
                      .watertight = false,
                      .source = "cloud",
                      .facets = {Square("G0", FacetClass::kGround, {90, -9, 0}, 20 * x, 20 * y)}}};
  return proxy;
}

double AreaOf(const Triangulation& t) {
  double area = 0;
  for (const auto& i : t.triangles) {
    const Vector3d a = t.vertices[i[1]] - t.vertices[i[0]], b = t.vertices[i[2]] - t.vertices[i[0]];
    area += a.cross(b).norm() / 2;
  }
  return area;
}

TEST(Triangulate, CoversThePolygonWithoutItsHoles) {
  const Proxy proxy = Model(false);
  const Triangulation with_hole = Triangulate(proxy.buildings[0].facets[0]);
  EXPECT_NEAR(AreaOf(with_hole), 11, 1e-9);
  EXPECT_EQ(with_hole.vertices.size(), 8u);
  EXPECT_EQ(with_hole.triangles.size(), 8u);
  EXPECT_EQ(Triangulate(proxy.buildings[0].facets[1]).triangles.size(), 2u);
}

TEST(Triangulate, TrianglesFaceTheNormal) {
  const Facet facet = Model(false).buildings[0].facets[0];
  const Triangulation t = Triangulate(facet);
  for (const auto& i : t.triangles) {
    const Vector3d normal =
        (t.vertices[i[1]] - t.vertices[i[0]]).cross(t.vertices[i[2]] - t.vertices[i[0]]);
    EXPECT_GT(normal.dot(facet.normal), 0);
  }
}

TEST(Triangulate, EdgesThatCrossMeetInAVertexOfTheirOwn) {
  Facet facet = Model(false).buildings[0].facets[1];
  const Vector3d origin = facet.outer[0];
  const auto at = [&](double x, double y) { return Vector3d(origin + Vector3d(x, y, 0)); };
  facet.outer = {at(0, 0), at(4, 0), at(0, 4), at(4, 4)};  // an hourglass
  const Triangulation crossed = Triangulate(facet);
  ASSERT_EQ(crossed.vertices.size(), 5u);
  EXPECT_LT((crossed.vertices[4] - at(2, 2)).norm(), 1e-9);
  EXPECT_NEAR(AreaOf(crossed), 8, 1e-9);
  // A ring that touches itself in a corner.
  facet.outer = {at(0, 0), at(2, 2), at(4, 0), at(4, 4), at(2, 2), at(0, 4)};
  EXPECT_NEAR(AreaOf(Triangulate(facet)), 8, 1e-9);
}

TEST(ObjText, HasAGroupPerFacetAndSharedVertices) {
  std::istringstream text(ObjText(Model(false)));
  std::set<std::string> groups;
  int vertices = 0, faces = 0, largest = 0;
  for (std::string word; text >> word;) {
    if (word == "g") {
      text >> word;
      groups.insert(word);
    }
    vertices += word == "v";
    if (word != "f") continue;
    ++faces;
    for (int i = 0, index = 0; i < 3 && text >> index; ++i) largest = std::max(largest, index);
  }
  EXPECT_EQ(groups, (std::set<std::string>{"B0001_W00", "B0001_R0", "G0"}));
  EXPECT_EQ(vertices, 8 + 2 + 4);  // the roof shares two corners with the wall
  EXPECT_EQ(largest, vertices);
  EXPECT_EQ(faces, 8 + 2 + 2);
}

TEST(CityJsonText, HasBuildingsPartsAndSemantics) {
  const auto city = nlohmann::json::parse(CityJsonText(Model(false)));
  EXPECT_EQ(city["type"], "CityJSON");
  EXPECT_EQ(city["version"], "2.0");
  EXPECT_EQ(city["CityObjects"]["B0001"]["children"][0], "B0001-1");
  const auto& part = city["CityObjects"]["B0001-1"];
  EXPECT_EQ(part["type"], "BuildingPart");
  EXPECT_EQ(part["parents"][0], "B0001");
  const auto& geometry = part["geometry"][0];
  EXPECT_EQ(geometry["type"], "MultiSurface");
  ASSERT_EQ(geometry["boundaries"].size(), 2u);
  EXPECT_EQ(geometry["boundaries"][0].size(), 2u);  // outer ring and hole
  EXPECT_EQ(geometry["semantics"]["values"], (std::vector<int>{0, 1}));
  EXPECT_EQ(geometry["semantics"]["surfaces"][0]["type"], "WallSurface");
  EXPECT_EQ(geometry["semantics"]["surfaces"][1]["id"], "B0001/R0");
  EXPECT_EQ(city["CityObjects"]["G0"]["type"], "LandUse");
}

TEST(CityJsonText, VerticesComeBackThroughTheTransform) {
  const auto city = nlohmann::json::parse(CityJsonText(Model(false)));
  const int index = city["CityObjects"]["B0001-1"]["geometry"][0]["boundaries"][0][0][1];
  const Vector3d expected(104, 0, 0);
  for (int axis = 0; axis < 3; ++axis) {
    ASSERT_TRUE(city["vertices"][index][axis].is_number_integer());
    const double value = city["vertices"][index][axis].get<double>() *
                             city["transform"]["scale"][axis].get<double>() +
                         city["transform"]["translate"][axis].get<double>();
    EXPECT_NEAR(value, expected[axis], 0.001);
  }
}

TEST(CityJsonText, AClosedBuildingIsASolid) {
  const auto city = nlohmann::json::parse(CityJsonText(Model(true)));
  const auto& geometry = city["CityObjects"]["B0001-1"]["geometry"][0];
  EXPECT_EQ(geometry["type"], "Solid");
  EXPECT_EQ(geometry["boundaries"].size(), 1u);
  EXPECT_EQ(geometry["boundaries"][0].size(), 2u);
  EXPECT_EQ(geometry["semantics"]["values"][0].size(), 2u);
}

TEST(CityJsonText, TurnsUpToZ) {
  Proxy proxy = Model(false);
  proxy.up = -Vector3d::UnitY();
  const auto city = nlohmann::json::parse(CityJsonText(proxy));
  const auto extent = city["metadata"]["geographicalExtent"];
  EXPECT_NEAR(extent[2].get<double>(), -91, 0.01);  // the ground's 100 m of y point down now
}

TEST(CityJsonText, AnEmptyModelIsValid) {
  const auto city = nlohmann::json::parse(CityJsonText({}));
  EXPECT_TRUE(city["CityObjects"].empty());
  EXPECT_TRUE(city["vertices"].is_array());
}

}  // namespace
}  // namespace stucco
