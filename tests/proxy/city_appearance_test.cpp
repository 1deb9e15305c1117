// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "proxy/output/cityjson.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using nlohmann::json;

constexpr char kFolder[] = "town_appearance";

// 4 m wide and 3 m high, facing south, with a window 1 m off its left edge and its foot.
Facet Wall() {
  Facet wall;
  wall.id = "B0001/W00";
  wall.normal = -Vector3d::UnitY();
  wall.outer = {{100, 0, 0}, {104, 0, 0}, {104, 0, 3}, {100, 0, 3}};
  wall.holes = {{{101, 0, 1}, {101, 0, 2}, {102, 0, 2}, {102, 0, 1}}};
  return wall;
}

// 4 m by 5 m, level.
Facet Roof() {
  Facet roof;
  roof.id = "B0001/R0";
  roof.facet_class = FacetClass::kRoof;
  roof.offset = 3;
  roof.outer = {{100, 0, 3}, {104, 0, 3}, {104, 5, 3}, {100, 5, 3}};
  return roof;
}

Proxy Town(bool watertight = false) {
  Proxy proxy;
  proxy.metric = true;
  proxy.buildings = {{.id = "B0001",
                      .watertight = watertight,
                      .source = "cloud",
                      .detail = {},
                      .facets = {Wall(), Roof()}}};
  return proxy;
}

// Of the wall: texels of 0.1 m, of which the last column sticks out on the right, the last row
// below.
TexturedFacet WallPicture() {
  TexturedFacet picture;
  picture.id = "B0001/W00";
  picture.image = "textures/B0001_W00.png";
  picture.width_px = 41;
  picture.height_px = 31;
  picture.metres_per_texel = 0.1;
  picture.origin = {100, 0, 3};
  picture.v_axis = -Vector3d::UnitZ();
  return picture;
}

TexturedFacet RoofPicture() {
  TexturedFacet picture = WallPicture();
  picture.id = "B0001/R0";
  picture.image = "textures/B0001_R0.png";
  picture.width_px = 40;
  picture.height_px = 50;
  picture.origin = {100, 5, 3};
  picture.v_axis = -Vector3d::UnitY();
  return picture;
}

TextureSet Textures(const std::vector<TexturedFacet>& facets) {
  TextureSet textures;
  textures.facets = facets;
  return textures;
}

// A file, and what it says of the building's surfaces.
struct City {
  City(const Proxy& proxy, const TextureSet& textures)
      : City(proxy, std::vector<ModelLook>{{kOwnLook, textures, "texture"}}) {}
  City(const Proxy& proxy, const std::vector<ModelLook>& looks)
      : made(TexturedCityJson(proxy, looks, kFolder)), file(json::parse(made.text)) {}

  json Geometry() const { return file.at("CityObjects").at("B0001-1").at("geometry").at(0); }
  json Values(const std::string& theme = kOwnLook) const {
    return Geometry().at("texture").at(theme).at("values");
  }
  // Where a ring's corner is on its picture, of a MultiSurface.
  Vector2d Uv(int surface, int ring, int corner) const {
    const int index = Values().at(surface).at(ring).at(corner + 1);
    const json& uv = file.at("appearance").at("vertices-texture").at(index);
    return {uv.at(0).get<double>(), uv.at(1).get<double>()};
  }

  TexturedCity made;
  json file;
};

// Values are as deep as boundaries, and each ring has its picture and a number a corner, or null.
void ExpectParallel(const json& boundaries, const json& values) {
  if (boundaries.at(0).is_number()) {
    if (values != json::array({nullptr})) {
      EXPECT_EQ(values.size(), boundaries.size() + 1);
    }
    return;
  }
  ASSERT_EQ(values.size(), boundaries.size());
  for (size_t i = 0; i < boundaries.size(); ++i) ExpectParallel(boundaries[i], values[i]);
}

TEST(CityAppearance, CornersAreWhereThePictureShowsThem) {
  const City city(Town(), Textures({WallPicture(), RoofPicture()}));
  // v is counted from the lower edge, which is a texel below the wall's foot.
  EXPECT_LT((city.Uv(0, 0, 0) - Vector2d(0, 1. / 31)).norm(), 1e-6);
  EXPECT_LT((city.Uv(0, 0, 2) - Vector2d(40. / 41, 1)).norm(), 1e-6);
  EXPECT_LT((city.Uv(0, 1, 1) - Vector2d(10. / 41, 21. / 31)).norm(), 1e-6);  // of the window
  EXPECT_LT((city.Uv(1, 0, 0) - Vector2d(0, 0)).norm(), 1e-6);                // of the roof
  EXPECT_LT((city.Uv(1, 0, 2) - Vector2d(1, 1)).norm(), 1e-6);
  ExpectParallel(city.Geometry()["boundaries"], city.Values());
}

TEST(CityAppearance, NamesThePicturesInItsFolder) {
  const City city(Town(), Textures({RoofPicture(), WallPicture()}));
  const json& appearance = city.file["appearance"];
  EXPECT_EQ(appearance["default-theme-texture"], kOwnLook);
  ASSERT_EQ(appearance["textures"].size(), 2u);
  ASSERT_EQ(city.made.pictures.size(), 2u);
  for (int i = 0; i < 2; ++i) {
    EXPECT_EQ(appearance["textures"][i]["type"], "PNG");
    EXPECT_EQ(appearance["textures"][i]["image"], city.made.pictures[i].name);
  }
  const int of_wall = city.Values()[0][0][0];
  EXPECT_EQ(city.made.pictures[of_wall].name, "town_appearance/B0001_W00.png");
  EXPECT_EQ(city.made.pictures[of_wall].image, "texture/textures/B0001_W00.png");
  EXPECT_EQ(city.Values()[0][1][0], of_wall);  // the window's edge is on it, too
}

TEST(CityAppearance, ASurfaceWithoutPictureHasNullForEachRing) {
  TexturedFacet unseen = WallPicture();
  unseen.image.clear();
  const City city(Town(), Textures({unseen, RoofPicture()}));
  EXPECT_EQ(city.Values()[0], json::parse("[[null],[null]]"));
  EXPECT_EQ(city.Values()[1][0].size(), 5u);
  EXPECT_EQ(city.made.pictures.size(), 1u);
  EXPECT_EQ(city.made.outdated, 0);
}

TEST(CityAppearance, ASolidHasAShellMore) {
  const City city(Town(true), Textures({WallPicture()}));
  EXPECT_EQ(city.Geometry()["type"], "Solid");
  ExpectParallel(city.Geometry()["boundaries"], city.Values());
  EXPECT_EQ(city.Values()[0][0][0][0], 0);
  EXPECT_EQ(city.Values()[0][1], json::parse("[[null]]"));
}

TEST(CityAppearance, CornersThatTheFileDropsAreDroppedHere) {
  Proxy proxy = Town();
  std::vector<Facet>& facets = proxy.buildings[0].facets;
  // Within a millimetre of their neighbours, at the end too; and a hole that vanishes.
  facets[0].outer = {{100, 0, 0}, {104, 0, 0}, {104, 0, 0.0003},
                     {104, 0, 3}, {100, 0, 3}, {100.0002, 0, 0}};
  facets[0].holes.insert(facets[0].holes.begin(),
                         {{103, 0, 1}, {103, 0, 1.0002}, {103.0002, 0, 1}});
  const City city(proxy, Textures({WallPicture()}));
  ASSERT_EQ(city.Geometry()["boundaries"][0].size(), 2u);
  EXPECT_EQ(city.Geometry()["boundaries"][0][0].size(), 4u);
  ExpectParallel(city.Geometry()["boundaries"], city.Values());
  EXPECT_LT((city.Uv(0, 0, 2) - Vector2d(40. / 41, 1)).norm(), 1e-6);
  EXPECT_LT((city.Uv(0, 1, 1) - Vector2d(10. / 41, 21. / 31)).norm(), 1e-6);
}

TEST(CityAppearance, AFacetThatVanishesTakesItsPictureWithIt) {
  Proxy proxy = Town();
  proxy.buildings[0].facets[0].outer = {{100, 0, 0}, {100.0001, 0, 0}, {100, 0, 0.0001}};
  const City city(proxy, Textures({WallPicture(), RoofPicture()}));
  ExpectParallel(city.Geometry()["boundaries"], city.Values());
  ASSERT_EQ(city.made.pictures.size(), 1u);
  EXPECT_EQ(city.made.pictures[0].image, "texture/textures/B0001_R0.png");
}

TEST(CityAppearance, CoordinatesStayOnThePicture) {
  TexturedFacet picture = WallPicture();
  picture.width_px = 39;  // a texel short on the right, and half a texel on the left
  picture.origin.x() += 0.05;
  const City city(Town(), Textures({picture}));
  EXPECT_EQ(city.Uv(0, 0, 0).x(), 0);
  EXPECT_EQ(city.Uv(0, 0, 1).x(), 1);
}

TEST(CityAppearance, LeavesOutPicturesOfAnEarlierModel) {
  TexturedFacet moved = WallPicture();
  moved.origin.x() += 1;
  const City city(Town(), Textures({moved, RoofPicture()}));
  EXPECT_EQ(city.Values()[0][0], json::array({nullptr}));
  EXPECT_EQ(city.made.outdated, 1);
  EXPECT_EQ(city.made.pictures.size(), 1u);
}

TEST(CityAppearance, TheGroundIsPaintedToo) {
  Proxy proxy = Town();
  Facet ground = Roof();
  ground.id = "G0";
  ground.facet_class = FacetClass::kGround;
  proxy.buildings.push_back(
      {.id = "G0", .watertight = false, .source = "cloud", .detail = {}, .facets = {ground}});
  TexturedFacet picture = RoofPicture();
  picture.id = "G0";
  const City city(proxy, Textures({picture}));
  const json& geometry = city.file["CityObjects"]["G0"]["geometry"][0];
  ExpectParallel(geometry["boundaries"], geometry["texture"][kOwnLook]["values"]);
  EXPECT_FALSE(city.Geometry().contains("texture"));  // of the house nothing is painted
}

TEST(CityAppearance, EachLookIsATheme) {
  const std::vector<ModelLook> looks = {
      {kOwnLook, Textures({WallPicture(), RoofPicture()}), "texture"},
      {"2026-spring", Textures({WallPicture()}), "epochs/2026-spring"},
      {"bare", {}, "epochs/bare"}};
  const City city(Town(), looks);
  EXPECT_EQ(city.file["appearance"]["default-theme-texture"], kOwnLook);
  ASSERT_EQ(city.made.pictures.size(), 3u);
  ExpectParallel(city.Geometry()["boundaries"], city.Values("2026-spring"));
  const int now = city.Values("2026-spring")[0][0][0];
  EXPECT_EQ(city.made.pictures[now].image, "epochs/2026-spring/textures/B0001_W00.png");
  EXPECT_EQ(city.made.pictures[now].name, "town_appearance/2026-spring/B0001_W00.png");
  EXPECT_NE(city.Values()[0][0][0], now);
  EXPECT_EQ(city.Values("2026-spring")[1], city.Values()[1]);  // the roof as before
  EXPECT_EQ(city.Values("bare"), city.Values());
}

TEST(CityAppearance, WhatOnlyALaterDayShowsIsPaintedInItsThemeAlone) {
  const std::vector<ModelLook> looks = {{kOwnLook, {}, "texture"},
                                        {"later", Textures({WallPicture()}), "epochs/later"}};
  const City city(Town(), looks);
  EXPECT_FALSE(city.Geometry()["texture"].contains(kOwnLook));
  EXPECT_EQ(city.Values("later")[0][0][0], 0);
  EXPECT_EQ(city.Values("later")[1], json::parse("[[null]]"));
}

TEST(CityAppearance, TheModelItselfIsTheSame) {
  City city(Town(), Textures({WallPicture()}));
  city.file.erase("appearance");
  city.file["CityObjects"]["B0001-1"]["geometry"][0].erase("texture");
  EXPECT_EQ(city.file, json::parse(CityJsonText(Town())));
  EXPECT_EQ(City(Town(), TextureSet()).made.text, CityJsonText(Town()));
}

}  // namespace
}  // namespace stucco
