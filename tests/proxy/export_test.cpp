// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <string>

#include "proxy/output/cityjson.h"
#include "proxy/output/obj.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

Facet Square(const std::string& id, FacetClass facet_class, const Vector3d& origin,
             const Vector3d& u, const Vector3d& v) {
  Facet facet;
  facet.id = id;
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
  Building building{
      .id = "B0001", .watertight = watertight, .source = "cloud", .detail = {}, .facets = {}};
  building.facets = {Square("B0001/W00", FacetClass::kWall, {100, 0, 0}, x, z),
                     Square("B0001/R0", FacetClass::kRoof, {100, 0, 3}, x, y)};
  building.facets[0].holes = {{{101, 0, 1}, {101, 0, 2}, {102, 0, 2}, {102, 0, 1}}};
  proxy.buildings = {building,
                     {.id = "G0",
                      .watertight = false,
                      .source = "cloud",
                      .detail = {},
                      .facets = {Square("G0", FacetClass::kGround, {90, -9, 0}, 20 * x, 20 * y)}}};
  return proxy;
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

TEST(CityJsonText, FurtherFacadesOfAWallAreOneText) {
  Proxy model = Model(false);
  const auto wall_of = [](const Proxy& written) {
    const auto city = nlohmann::json::parse(CityJsonText(written));
    return city["CityObjects"]["B0001-1"]["geometry"][0]["semantics"]["surfaces"][0];
  };
  EXPECT_FALSE(wall_of(model).contains("other_facades"));
  model.buildings[0].facets[0].planned_facades = {"B0001/F00", "B0002/F03", "B0003/F01"};
  EXPECT_EQ(wall_of(model)["facade"], "B0001/F00");
  EXPECT_EQ(wall_of(model)["other_facades"], "B0002/F03 B0003/F01");
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

// One id of a map that stands in two places: two solids, as no solid has two pieces.
TEST(CityJsonText, WhatStandsInTwoPlacesIsTwoParts) {
  const auto box_at = [](double east) {
    const Vector3d o(east, 0, 0);
    const Vector3d x = 4 * Vector3d::UnitX(), y = 5 * Vector3d::UnitY(), z = 3 * Vector3d::UnitZ();
    return std::vector<Facet>{Square("", FacetClass::kGround, o, y, x),
                              Square("", FacetClass::kRoof, o + z, x, y),
                              Square("", FacetClass::kWall, o, x, z),
                              Square("", FacetClass::kWall, o + x, y, z),
                              Square("", FacetClass::kWall, o + x + y, -x, z),
                              Square("", FacetClass::kWall, o + y, -y, z)};
  };
  Proxy proxy = Model(true);
  Building& building = proxy.buildings[0];
  building.facets = box_at(0);
  for (const Facet& facet : box_at(10)) building.facets.push_back(facet);
  std::swap(building.facets[1], building.facets[8]);
  const auto city = nlohmann::json::parse(CityJsonText(proxy))["CityObjects"];
  EXPECT_EQ(city["B0001"]["children"], nlohmann::json({"B0001-1", "B0001-2"}));
  for (const char* part : {"B0001-1", "B0001-2"}) {
    const auto& geometry = city[part]["geometry"][0];
    EXPECT_EQ(geometry["type"], "Solid");
    ASSERT_EQ(geometry["boundaries"].size(), 1u);
    EXPECT_EQ(geometry["boundaries"][0].size(), 6u);
    EXPECT_EQ(geometry["semantics"]["values"][0].size(), 6u);
    EXPECT_EQ(city[part]["parents"][0], "B0001");
  }
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
