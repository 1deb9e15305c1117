// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/surveyed_places.h"

#include <gtest/gtest.h>

#include "tests/survey/support.h"

namespace stucco::test {
namespace {

PlacesOnEarth Places(const std::string& crs, const Eigen::Vector3d& point) {
  const std::vector<Eigen::Vector3d> points = {point};
  return PlacesFromSystem(crs, points, "gcp_list.txt");
}

// Graz: UTM zone 33.
void ExpectGraz(const std::string& crs, const Eigen::Vector3d& point, double height_m) {
  SCOPED_TRACE(crs);
  const PlacesOnEarth places = Places(crs, point);
  ASSERT_TRUE(places.places[0]);
  EXPECT_NEAR(places.places[0]->latitude_deg, 47.0767, 1e-4);
  EXPECT_NEAR(places.places[0]->longitude_deg, 15.4371, 1e-4);
  EXPECT_NEAR(places.places[0]->height_m, height_m, 1e-6);
}

TEST(SurveyedPlaces, KnowsTheUsualNames) {
  const Eigen::Vector3d utm(533181.4, 5213780.2, 470);
  ExpectGraz("EPSG:32633", utm, 470);
  ExpectGraz("EPSG:25833", utm, 470);
  ExpectGraz("WGS84 UTM 33N", utm, 470);
  ExpectGraz("+proj=utm +zone=33 +datum=WGS84 +units=m +no_defs", utm, 470);
  // Longitude first, although the system lists latitude first.
  ExpectGraz("EPSG:4326", {15.4371, 47.0767, 470}, 470);
  ExpectGraz("EPSG:4979", {15.4371, 47.0767, 470}, 470);
}

TEST(SurveyedPlaces, SouthernZones) {
  const PlacesOnEarth places = Places("WGS84 UTM 56S", {334368.6, 6252084.0, 5});
  ASSERT_TRUE(places.places[0]);
  EXPECT_NEAR(places.places[0]->latitude_deg, -33.857, 1e-2);
  EXPECT_NEAR(places.places[0]->longitude_deg, 151.21, 1e-2);
}

TEST(SurveyedPlaces, HeightsStayAsTheyAre) {
  // A height above the sea is not made one above the ellipsoid, whatever grids there are.
  const PlacesOnEarth places = Places("EPSG:25832+7837", {500000, 5500000, 312.5});
  ASSERT_TRUE(places.places[0]);
  EXPECT_EQ(places.places[0]->height_m, 312.5);
  EXPECT_TRUE(places.doubt.empty());
}

TEST(SurveyedPlaces, FeetOfAVerticalAxisBecomeMetres) {
  const PlacesOnEarth places = Places("EPSG:2263+6360", {981000, 200000, 100});
  ASSERT_TRUE(places.places[0]);
  EXPECT_NEAR(places.places[0]->height_m, 30.48, 0.001);
  EXPECT_NEAR(places.places[0]->latitude_deg, 40.7, 0.1);
  EXPECT_TRUE(places.doubt.empty());
}

TEST(SurveyedPlaces, DoubtsHeightsBesideFeet) {
  const PlacesOnEarth places = Places("EPSG:2263", {981000, 200000, 100});
  EXPECT_EQ(places.places[0]->height_m, 100);
  EXPECT_NE(places.doubt.find("taken as metres"), std::string::npos);
}

TEST(SurveyedPlaces, RefusesWhatIsNone) {
  for (const char* crs :
       {"UTM zone 33", "EPSG:1", "WGS84 UTM 61N", "WGS84 UTM 33X", "hello", "/etc/passwd",
        "http://localhost/crs", "LOCAL_CS[\"plant\",UNIT[\"metre\",1]]"}) {
    SCOPED_TRACE(crs);
    ExpectBadInput([&] { Places(crs, {0, 0, 0}); }, crs);
  }
}

TEST(SurveyedPlaces, PointsOfNoPlaceAreNone) {
  EXPECT_FALSE(Places("EPSG:4326", {47.0, 154.0, 1}).places[0]);  // latitude of 154 degrees
  EXPECT_FALSE(Places("EPSG:32633", {1e12, 1e12, 1}).places[0]);
}

}  // namespace
}  // namespace stucco::test
