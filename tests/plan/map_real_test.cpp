// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Public maps of real towns. They are not part of the repository: they are looked for in the folder
// that STUCCO_DATA names, else in ../shared/data beside it.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <map>
#include <set>

#include "plan/map/internal/ogr.h"
#include "plan/map/read_site.h"
#include "survey/error.h"
#include "survey/plan_frame.h"

namespace stucco::plan {
namespace {

std::filesystem::path DataFolder() {
  if (const char* named = std::getenv("STUCCO_DATA")) return named;
  return std::filesystem::path(STUCCO_ROOT) / "../shared/data";
}

const std::filesystem::path kMaps = DataFolder() / "footprints";

std::set<std::string> Buildings(const Site& site) {
  std::set<std::string> buildings;
  for (const Footprint& footprint : site.footprints) buildings.insert(footprint.building);
  return buildings;
}

class RealMaps : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::is_directory(kMaps)) GTEST_SKIP() << kMaps << " is not here";
  }

  static Site Read(const std::string& file, double altitude_m, const std::string& crs = "") {
    PlanOptions options;
    options.altitude_m = altitude_m;
    options.map_crs = crs;
    return ReadSite({.map = kMaps / file}, options);
  }

  // What every site must be, whatever the map.
  static void ExpectSound(const Site& site) {
    for (size_t i = 0; i < site.footprints.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        const Footprint& a = site.footprints[i];
        const Footprint& b = site.footprints[k];
        const bool above =
            a.building == b.building && (a.z_m.to_m <= b.z_m.from_m || b.z_m.to_m <= a.z_m.from_m);
        EXPECT_TRUE(above || !internal::InteriorsMeet(a.outline, b.outline))
            << a.building << " and " << b.building;
      }
    }
    std::set<std::string> ids;
    for (const Facade& facade : site.facades) {
      EXPECT_TRUE(ids.insert(facade.id).second) << facade.id;
      EXPECT_GT(facade.length_m(), 0.05);
      EXPECT_GT(facade.z_m.length_m(), 0);
    }
  }
};

TEST_F(RealMaps, Prague) {
  const Site site = Read("prague_bubenec/bubenec.gpkg", 60);
  EXPECT_EQ(Buildings(site).size(), 144u);
  EXPECT_TRUE(Buildings(site).contains("B0001"));
  EXPECT_TRUE(Buildings(site).contains("B0144"));
  EXPECT_GT(site.facades.size(), 1000u);
  ExpectSound(site);
}

// One map in two formats, coordinate systems and precisions (3857, and 1e-7 degrees of WGS 84).
TEST_F(RealMaps, PragueIsTheSameFromGeoPackageAndGeoJson) {
  const Site one = Read("prague_bubenec/bubenec.gpkg", 60);
  const Site two = Read("prague_bubenec/bubenec_buildings_wgs84_converted.geojson", 60);
  ASSERT_EQ(one.facades.size(), two.facades.size());
  std::map<std::string, const Facade*> by_id;
  for (const Facade& facade : one.facades) by_id[facade.id] = &facade;
  const auto in_one = [&](const Eigen::Vector2d& p) {
    return PlanFromGeodetic(one.origin, GeodeticFromPlan(two.origin, p));
  };
  for (const Facade& facade : two.facades) {
    ASSERT_TRUE(by_id.contains(facade.id)) << facade.id;
    const Facade& other = *by_id.at(facade.id);
    EXPECT_LT((in_one(facade.a) - other.a).norm(), 0.02) << facade.id;
    EXPECT_LT((in_one(facade.b) - other.b).norm(), 0.02) << facade.id;
  }
}

TEST_F(RealMaps, Delft) {
  const Site site = Read("cityjson/delft.json", 0);
  EXPECT_EQ(Buildings(site).size(), 160u);
  EXPECT_NEAR(site.safe_altitude_m, 18.29, 0.01);
  EXPECT_NEAR(site.origin.latitude_deg, 52.01, 0.01);
  EXPECT_NEAR(site.origin.longitude_deg, 4.35, 0.02);
  for (const Footprint& footprint : site.footprints) EXPECT_TRUE(footprint.top_known);
  ExpectSound(site);
}

TEST_F(RealMaps, Zurich) {
  const Site site = Read("cityjson/zurich_subset_lod2.json", 0);
  EXPECT_EQ(Buildings(site).size(), 49u);
  ExpectSound(site);
}

TEST_F(RealMaps, RotterdamAndTheHagueNeedACoordinateSystem) {
  EXPECT_EQ(Buildings(Read("cityjson/rotterdam_subset.json", 0, "EPSG:28992")).size(), 16u);
  EXPECT_EQ(Buildings(Read("cityjson/DH_01_subs.city.json", 0, "EPSG:28992")).size(), 4u);
  try {
    Read("cityjson/rotterdam_subset.json", 0);
    ADD_FAILURE();
  } catch (const Error& error) {
    EXPECT_NE(error.remedy().find("--map-crs"), std::string::npos);
  }
}

}  // namespace
}  // namespace stucco::plan
