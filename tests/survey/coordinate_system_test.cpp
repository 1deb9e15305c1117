// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/coordinate_system.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/survey/support.h"

namespace stucco::test {
namespace {

constexpr char kPlant[] = "LOCAL_CS[\"plant\",UNIT[\"metre\",1]]";

TEST(CoordinateSystem, IsOnEarthOrNone) {
  for (const char* crs : {"EPSG:25832", "EPSG:4326", "EPSG:2263+6360", "+proj=utm +zone=33",
                          "http://www.opengis.net/def/crs/EPSG/0/25832"}) {
    EXPECT_TRUE(IsCrsOnEarth(crs)) << crs;
  }
  for (const char* crs :
       {"", "hello", "EPSG:1", kPlant, "EPSG:7837", "/etc/passwd", "http://localhost/crs"}) {
    EXPECT_FALSE(IsCrsOnEarth(crs)) << crs;
  }
}

TEST(CoordinateSystem, CountsInDegreesOrLengths) {
  EXPECT_TRUE(IsCrsGeographic("EPSG:4326"));
  EXPECT_TRUE(IsCrsGeographic("EPSG:4979"));
  EXPECT_FALSE(IsCrsGeographic("EPSG:25832"));
  EXPECT_FALSE(IsCrsGeographic("hello"));
}

TEST(CoordinateSystem, UnitsOfBothAxes) {
  constexpr double kFoot_m = 1200.0 / 3937;  // of the United States' survey
  EXPECT_EQ(UnitsOfCrs("EPSG:25832").horizontal_m, 1);
  EXPECT_FALSE(UnitsOfCrs("EPSG:25832").vertical_m);
  EXPECT_NEAR(UnitsOfCrs("EPSG:2263").horizontal_m, kFoot_m, 1e-12);
  EXPECT_FALSE(UnitsOfCrs("EPSG:2263").vertical_m);
  EXPECT_NEAR(UnitsOfCrs("EPSG:2263+6360").vertical_m.value(), kFoot_m, 1e-12);
  EXPECT_EQ(UnitsOfCrs("EPSG:25832+7837").vertical_m, 1);
  EXPECT_EQ(UnitsOfCrs("EPSG:4979").vertical_m, 1);
}

TEST(CoordinateSystem, ThereAndBackAgain) {
  const std::vector<Geodetic> places = {{47.0767, 15}, {47.0767, 15.4371}, {0, 12.5}};
  for (const char* crs : {"EPSG:32633", "EPSG:4326", "EPSG:3857"}) {
    SCOPED_TRACE(crs);
    const auto points = CrsFromGeodetic(crs, places, "test");
    const auto back = GeodeticFromCrs(crs, points, "test");
    ASSERT_EQ(back.size(), places.size());
    for (size_t i = 0; i < places.size(); ++i) {
      EXPECT_NEAR(back[i].latitude_deg, places[i].latitude_deg, 1e-9);
      EXPECT_NEAR(back[i].longitude_deg, places[i].longitude_deg, 1e-9);
    }
  }
  // East comes first, whatever the system says; zone 33 has its meridian at 15 degrees.
  const auto utm = CrsFromGeodetic("EPSG:32633", places, "test");
  EXPECT_NEAR(utm[0].x(), 500000, 1e-6);
  EXPECT_NEAR(CrsFromGeodetic("EPSG:4326", places, "test")[1].x(), 15.4371, 1e-12);
}

TEST(CoordinateSystem, PointsOfNoPlaceBecomeNaN) {
  const std::vector<Eigen::Vector2d> points = {{500000, 0}, {1e12, 1e12}};
  const auto places = GeodeticFromCrs("EPSG:32633", points, "test");
  EXPECT_NEAR(places[0].longitude_deg, 15, 1e-9);
  EXPECT_TRUE(std::isnan(places[1].latitude_deg));
  EXPECT_TRUE(std::isnan(places[1].longitude_deg));
}

TEST(CoordinateSystem, UnknownSystemsNameTheFile) {
  const std::vector<Eigen::Vector2d> points = {{0, 0}};
  ExpectBadInput([&] { GeodeticFromCrs("EPSG:1", points, "town.gpkg"); }, "town.gpkg");
  ExpectBadInput([&] { GeodeticFromCrs(kPlant, points, "plant.gpkg"); }, "plant.gpkg");
  ExpectBadInput([&] { CrsFromGeodetic("hello", {}, "terrain.tif"); }, "terrain.tif");
}

TEST(CoordinateSystemDeathTest, HasUnitsOnEarthOnly) {
  EXPECT_DEATH(UnitsOfCrs("hello"), "IsCrsOnEarth");
}

}  // namespace
}  // namespace stucco::test
