// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plan/map/home.h"
#include "plan/map/read_dem.h"
#include "plan/map/read_site.h"
#include "survey/files.h"
#include "survey/geometry2d.h"
#include "tests/plan/made_map.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

MadeBuilding House(int id, const Ring& ring, const std::string& height = "10") {
  std::map<std::string, std::string> attributes = {{"id", std::to_string(id)}};
  if (!height.empty()) attributes["height"] = height;
  return {{{ring}}, attributes};
}

MadeBuilding Area(const Ring& ring) {
  return {{{ring}}, {}};
}

// Three houses 60 m apart in a row from the place of made maps to the east.
std::vector<MadeBuilding> Row(const std::string& height = "10") {
  return {House(1, Rectangle(0, 0, 20, 12), height), House(2, Rectangle(60, 0, 80, 12), height),
          House(3, Rectangle(120, 0, 140, 12), height)};
}

// A position of made maps in the frame of a site.
Eigen::Vector2d In(const Site& site, double x, double y) {
  return PlanFromGeodetic(site.origin, GeodeticFromPlan(OriginNear(kMadePlace), {x, y}));
}

std::string AsText(const Eigen::Vector2d& position) {
  const Geodetic place = GeodeticFromPlan(OriginNear(kMadePlace), position);
  return fmt::format("{:.7f},{:.7f}", place.latitude_deg, place.longitude_deg);
}

class ReadSiteTest : public testing::Test {
 protected:
  Site Read(const std::vector<MadeBuilding>& buildings) {
    WriteGeoJson(folder_ / "map.geojson", buildings);
    inputs_.map = folder_ / "map.geojson";
    return ReadSite(inputs_, options_);
  }
  std::string ComplaintAbout(const std::vector<MadeBuilding>& buildings) {
    return Complaint([&] { Read(buildings); });
  }
  std::filesystem::path Areas(const std::string& name, const std::vector<Ring>& rings) {
    std::vector<MadeBuilding> areas;
    for (const Ring& ring : rings) areas.push_back(Area(ring));
    WriteGeoJson(folder_ / name, areas);
    return folder_ / name;
  }

  test::TemporaryFolder folder_;
  SiteInputs inputs_;
  PlanOptions options_;
};

TEST_F(ReadSiteTest, FillsInEverything) {
  const Site site = Read(Row());
  EXPECT_EQ(site.footprints.size(), 3u);
  EXPECT_EQ(site.facades.size(), 12u);
  EXPECT_EQ(site.safe_altitude_m, 20);
  EXPECT_EQ(site.CeilingAt({0, 0}), 20);
  EXPECT_EQ(site.footprints[0].blocked_to_m, 20);
  EXPECT_THAT(site.crs, HasSubstr("+proj=tmerc"));
  EXPECT_EQ(site.origin.height_m, 0);
  EXPECT_TRUE(site.repairs.empty());
  EXPECT_NEAR(In(site, 70, 6).norm(), 0, 1);
  // The hull of the houses, 20 m (H) wider.
  EXPECT_NEAR(Area(site.area), 140 * 12 + 20 * 2 * 152 + std::numbers::pi * 400, 15);
  EXPECT_TRUE(Contains(site.area, In(site, 70, 31)));
  EXPECT_FALSE(Contains(site.area, In(site, 70, 33)));
}

TEST_F(ReadSiteTest, SameFileSameSite) {
  const Site one = Read(Row());
  const Site two = Read(Row());
  ASSERT_EQ(one.facades.size(), two.facades.size());
  for (size_t i = 0; i < one.facades.size(); ++i) {
    EXPECT_EQ(one.facades[i].id, two.facades[i].id);
    EXPECT_EQ(one.facades[i].a, two.facades[i].a);
  }
  EXPECT_EQ(one.area.rings, two.area.rings);
  EXPECT_EQ(one.home, two.home);
}

TEST_F(ReadSiteTest, AltitudeMustBeSaid) {
  EXPECT_THAT(
      ComplaintAbout({House(1, Rectangle(0, 0, 9, 9)), House(2, Rectangle(30, 0, 39, 9), "")}),
      AllOf(HasSubstr("1 of 2 buildings have no height or 0, B0002 first"),
            HasSubstr("--altitude")));
  options_.altitude_m = 60;
  const Site site = Read({House(1, Rectangle(0, 0, 9, 9)), House(2, Rectangle(30, 0, 39, 9), "")});
  EXPECT_EQ(site.safe_altitude_m, 60);
  EXPECT_EQ(site.footprints[0].blocked_to_m, 20);
  EXPECT_EQ(site.footprints[1].blocked_to_m, 60);
  EXPECT_EQ(site.footprints[1].z_m.to_m, 50);
}

MadeBuilding Storeys(int id, const Ring& ring, const std::string& levels) {
  return {{{ring}}, {{"id", std::to_string(id)}, {"building:levels", levels}}};
}

TEST_F(ReadSiteTest, StoreysAreNoHeights) {
  const std::vector<MadeBuilding> town = {House(1, Rectangle(0, 0, 9, 9)),
                                          Storeys(2, Rectangle(30, 0, 39, 9), "5"),
                                          House(3, Rectangle(60, 0, 69, 9), "")};
  EXPECT_THAT(ComplaintAbout(town),
              AllOf(HasSubstr("2 of 3 buildings have no height"),
                    HasSubstr("1 of them have a number of storeys (building:levels)"),
                    HasSubstr("--altitude 35"), HasSubstr("building B0002 suggests 35")));
  options_.altitude_m = 40;
  const Site site = Read(town);
  EXPECT_EQ(site.footprints[1].z_m.to_m, 20);  // where its walls are expected to end
  EXPECT_FALSE(site.footprints[1].top_known);
  EXPECT_FALSE(site.facades[4].top_known);
  EXPECT_EQ(site.footprints[1].blocked_to_m, 40);  // but nothing flies there
  EXPECT_EQ(site.footprints[2].z_m.to_m, 30);
  EXPECT_THAT(site.warnings,
              testing::ElementsAre(HasSubstr("2 of 3 buildings have no known height (1 a number")));
  options_.altitude_m = 25;
  EXPECT_THAT(Read(town).warnings, testing::Contains(HasSubstr("B0002 suggest up to 20 m")));
}

TEST_F(ReadSiteTest, PartsAboveTheAltitudeAreRefused) {
  MadeBuilding part = House(2, Rectangle(30, 0, 39, 9), "");
  part.attributes["min_height"] = "35";
  options_.altitude_m = 40;
  EXPECT_THAT(ComplaintAbout({part}), HasSubstr("building B0002 is 35.0 m high"));
}

TEST_F(ReadSiteTest, ErrorsLargerThanTheDistanceAreRefused) {
  options_.d_min_m = 4;
  EXPECT_THAT(ComplaintAbout(Row()), AllOf(HasSubstr("may be used up"), HasSubstr("--map-error")));
  options_.map_error_m = 0.3;
  options_.height_error_m = 0.5;
  options_.position_error_m = 0.2;
  EXPECT_EQ(ComplaintAbout(Row()), "");
}

TEST_F(ReadSiteTest, AShedAndTwoThousandSheds) {
  EXPECT_EQ(Read({House(1, Rectangle(0, 0, 3, 2.5), "2.4")}).safe_altitude_m, 12.4);
  std::vector<MadeBuilding> sheds;
  for (int i = 0; i < 2000; ++i) {
    const double x = 12. * (i % 50);
    const double y = 12. * (i / 50);
    sheds.push_back(House(i + 1, Rectangle(x, y, x + 4, y + 3), "2.4"));
  }
  const Site site = Read(sheds);
  EXPECT_EQ(site.facades.size(), 8000u);
  EXPECT_EQ(site.safe_altitude_m, 12.4);
  EXPECT_TRUE(site.warnings.empty());
}

TEST_F(ReadSiteTest, AreasThatCutABuildingTakeAllOfIt) {
  inputs_.area_of_interest = Areas("area.geojson", {Rectangle(-5, -5, 10, 30)});
  const Site site = Read(Row());
  EXPECT_TRUE(site.footprints[0].in_area);
  EXPECT_FALSE(site.footprints[1].in_area);
  EXPECT_NEAR(Area(site.footprints[0].outline), 20 * 12, 0.1);
  EXPECT_EQ(site.facades.size(), 4u);
  const auto cut = HasSubstr("the border of the area cuts it");
  EXPECT_THAT(site.repairs, testing::ElementsAre(AllOf(HasSubstr("B0001"), cut)));
  inputs_.area_of_interest = Areas("area.geojson", {Rectangle(-5, -5, 30, 30)});
  EXPECT_THAT(Read(Row()).repairs, testing::Each(Not(cut)));
}

TEST_F(ReadSiteTest, AltitudeBelowABuildingIsRefused) {
  options_.altitude_m = 40;
  EXPECT_THAT(
      ComplaintAbout({House(7, Rectangle(0, 0, 9, 9), "35"), House(8, Rectangle(30, 0, 39, 9))}),
      AllOf(HasSubstr("building B0007 is 35.0 m high"), HasSubstr("--altitude 45")));
  options_.altitude_m = 45;
  EXPECT_EQ(ComplaintAbout({House(7, Rectangle(0, 0, 9, 9), "35")}), "");
  options_.altitude_m = 4;
  EXPECT_THAT(ComplaintAbout(Row("")), HasSubstr("lower than the lowest flight"));
}

TEST_F(ReadSiteTest, AreaOfInterestLeavesObstacles) {
  inputs_.area_of_interest = Areas("area.geojson", {Rectangle(50, -20, 90, 30)});
  std::vector<MadeBuilding> buildings = Row();
  buildings.push_back(House(4, Rectangle(5000, 0, 5020, 12), ""));  // would ask for an altitude
  const Site site = Read(buildings);
  ASSERT_EQ(site.footprints.size(), 3u);
  EXPECT_FALSE(site.footprints[0].in_area);
  EXPECT_TRUE(site.footprints[1].in_area);
  ASSERT_EQ(site.facades.size(), 4u);
  EXPECT_EQ(site.facades[0].id, "B0002/F00");
  // Views stay around the one house that is wanted.
  EXPECT_NEAR(Area(site.area), 20 * 12 + 20 * 2 * 32 + std::numbers::pi * 400, 15);
  EXPECT_THAT(site.repairs, testing::ElementsAre("1 buildings far from the area left out"));
}

TEST_F(ReadSiteTest, AreaOfInterestElsewhereIsRefused) {
  inputs_.area_of_interest = Areas("area.geojson", {Rectangle(20, 20, 50, 50)});
  EXPECT_THAT(ComplaintAbout(Row()), HasSubstr("no building of"));
  inputs_.area_of_interest = Areas("area.geojson", {Rectangle(20000, 20, 20050, 50)});
  EXPECT_THAT(ComplaintAbout(Row()),
              AllOf(HasSubstr("area.geojson: no building of"), HasSubstr("of one place")));
}

TEST_F(ReadSiteTest, UnusableHeightsAreNamed) {
  const MadeBuilding negative = House(1, Rectangle(0, 0, 9, 9), "-5");
  const MadeBuilding text = House(2, Rectangle(30, 0, 39, 9), "abc");
  const MadeBuilding huge = House(3, Rectangle(60, 0, 69, 9), "1000000000");
  EXPECT_THAT(ComplaintAbout({negative}), HasSubstr("(B0001: height -5 m is impossible; ignored)"));
  EXPECT_THAT(ComplaintAbout({text}), HasSubstr("(B0002: height \"abc\" is no length; ignored)"));
  EXPECT_THAT(ComplaintAbout({huge}), HasSubstr("(B0003: height 1000000000 m is impossible"));
  EXPECT_THAT(ComplaintAbout(Row("")), Not(HasSubstr("(B")));
  options_.altitude_m = 60;
  EXPECT_EQ(Read({negative, text, huge}).repairs.size(), 3u);
}

TEST_F(ReadSiteTest, HeightsBeyondEveryAltitudeAreRefused) {
  EXPECT_EQ(ComplaintAbout(Row("490")), "");
  EXPECT_THAT(ComplaintAbout(Row("490.5")),
              AllOf(HasSubstr("building B0001 is 490.5 m high"), HasSubstr("check the unit")));
  options_.altitude_m = 500;
  EXPECT_THAT(ComplaintAbout(Row("800")), HasSubstr("check the unit"));
}

TEST_F(ReadSiteTest, EmptyAreasAreRefused) {
  WriteFile(folder_ / "none.geojson", R"({"type":"FeatureCollection","features":[]})");
  inputs_.no_fly = folder_ / "none.geojson";
  const auto says = AllOf(HasSubstr("has no polygons"), HasSubstr("leave the option out"));
  EXPECT_THAT(ComplaintAbout(Row()), says);
  inputs_ = {};
  inputs_.area_of_interest = folder_ / "none.geojson";
  EXPECT_THAT(ComplaintAbout(Row()), says);
}

TEST_F(ReadSiteTest, SharedIdsAreNoted) {
  EXPECT_THAT(Read({House(7, Rectangle(0, 0, 9, 9)), House(7, Rectangle(30, 0, 39, 9))}).repairs,
              testing::ElementsAre("B0007-2: another building has its id; numbered"));
}

TEST_F(ReadSiteTest, NoFlyZonesAreJoined) {
  inputs_.no_fly = Areas("zones.geojson", {Rectangle(0, 50, 40, 90), Rectangle(30, 60, 70, 80),
                                           Reversed(Rectangle(100, 50, 120, 70))});
  const Site site = Read(Row());
  ASSERT_EQ(site.no_fly.size(), 2u);
  double area = 0;
  for (const Polygon& zone : site.no_fly) area += Area(zone);
  EXPECT_NEAR(area, 1600 + 600 + 400, 0.1);
}

TEST_F(ReadSiteTest, DefaultHomeIsSafeAndSouth) {
  const Site open = Read(Row());
  EXPECT_NEAR((open.home.head<2>() - In(open, 70, -15)).norm(), 0, 0.1);
  // A zone over the south side moves it to the rim of the zone.
  inputs_.no_fly = Areas("zones.geojson", {Rectangle(-100, -100, 240, -2)});
  const Site site = Read(Row());
  for (const Polygon& zone : site.no_fly) {
    EXPECT_GE(Distance(zone, site.home.head<2>()), 1);
  }
  for (const Footprint& footprint : site.footprints) {
    EXPECT_GE(Distance(footprint.outline, site.home.head<2>()), 11);
  }
  EXPECT_LT((site.home - open.home).norm(), 60);
}

TEST_F(ReadSiteTest, TakeOffPlacesAreSafeAndSpread) {
  inputs_.no_fly = Areas("zones.geojson", {Rectangle(-100, 14, 240, 100)});
  const Site site = Read(Row());
  ASSERT_GT(site.take_off.size(), 2u);
  std::vector<Eigen::Vector3d> places = site.take_off;
  places.push_back(site.home);
  for (size_t i = 0; i < places.size(); ++i) {
    for (const Polygon& zone : site.no_fly) {
      EXPECT_GE(Distance(zone, places[i].head<2>()), 1);
    }
    for (const Footprint& footprint : site.footprints) {
      EXPECT_GE(Distance(footprint.outline, places[i].head<2>()), 11);
    }
    for (size_t k = 0; k < i; ++k) EXPECT_GE((places[i] - places[k]).norm(), 40);
  }
}

TEST_F(ReadSiteTest, CourtyardsAreNoTakeOffPlaces) {
  const Ring court = Reversed(Rectangle(30, 30, 170, 170));
  const MadeBuilding block{{{Rectangle(0, 0, 200, 200), court}}, {{"id", "1"}, {"height", "10"}}};
  const Site site = Read({block});
  EXPECT_FALSE(site.take_off.empty());
  for (const Eigen::Vector3d& place : site.take_off) {
    const Eigen::Vector2d middle = In(site, 100, 100);
    EXPECT_GT((place.head<2>() - middle).cwiseAbs().maxCoeff(), 100);
  }
}

// Four houses around a yard of 140 m: one gap of 2 m lets a pilot in, one of half a metre does not.
TEST_F(ReadSiteTest, YardsThatSeveralHousesCloseInAreNoTakeOffPlaces) {
  const auto places_in_yard = [&](double gap_m) {
    const std::vector<Ring> walls{Rectangle(0, 0, 200, 30), Rectangle(170, 30, 200, 170),
                                  Rectangle(0, 170, 200, 200), Rectangle(0, 30 + gap_m, 30, 170)};
    std::vector<MadeBuilding> houses;
    for (size_t i = 0; i < walls.size(); ++i) {
      houses.push_back({{{walls[i]}}, {{"id", std::to_string(i + 1)}, {"height", "10"}}});
    }
    const Site site = Read(houses);
    const Eigen::Vector2d middle = In(site, 100, 100);
    return std::ranges::count_if(site.take_off, [&](const Eigen::Vector3d& place) {
      return (place.head<2>() - middle).cwiseAbs().maxCoeff() < 100;
    });
  };
  EXPECT_EQ(places_in_yard(0), 0);
  EXPECT_EQ(places_in_yard(0.5), 0);
  EXPECT_GT(places_in_yard(2), 0);
}

TEST_F(ReadSiteTest, AGivenHomeIsTheOnlyOne) {
  inputs_.home = AsText({70, -30});
  EXPECT_TRUE(Read(Row()).take_off.empty());
}

TEST_F(ReadSiteTest, UnsafeHomesAreRefused) {
  inputs_.no_fly = Areas("zones.geojson", {Rectangle(0, 50, 40, 90)});
  const auto complaint = [&](const std::string& home) {
    inputs_.home = home;
    return ComplaintAbout(Row());
  };
  EXPECT_EQ(complaint(AsText({70, -30})), "");
  EXPECT_THAT(complaint(AsText({20, 70})), HasSubstr("inside a no-fly zone"));
  EXPECT_THAT(complaint(AsText({70, 6})), HasSubstr("0 m from building B0002"));
  EXPECT_THAT(complaint(AsText({70, -7})), HasSubstr("7 m from building B0002"));
  EXPECT_THAT(complaint("14.4,50.1"), HasSubstr("km from the buildings"));
  for (const char* text : {"", "50.1", "north,east", "91,14", "50.1,14.4,200"}) {
    EXPECT_THAT(complaint(text), HasSubstr("is no latitude and longitude")) << text;
  }
  inputs_.home = AsText({70, -30});
  const Site site = Read(Row());
  EXPECT_NEAR((site.home.head<2>() - In(site, 70, -30)).norm(), 0, 0.02);
}

TEST_F(ReadSiteTest, NoPlaceToTakeOffIsSaid) {
  inputs_.no_fly = Areas("zones.geojson", {Rectangle(-9000, -9000, 9000, 9000)});
  EXPECT_THAT(ComplaintAbout(Row()), HasSubstr("no place to take off"));
}

TEST_F(ReadSiteTest, MapsThatSpanCountriesAreRefused) {
  std::vector<MadeBuilding> buildings = Row();
  buildings.push_back(House(4, Rectangle(90000, 0, 90020, 12)));
  EXPECT_THAT(ComplaintAbout(buildings),
              AllOf(HasSubstr("spans 90 km"), HasSubstr("B0004 lies 90 km from the others")));
}

TEST_F(ReadSiteTest, CoordinateSystemsMustBeKnown) {
  const auto complaint = [&](const std::string& file, const std::string& crs) {
    inputs_.map = folder_ / file;
    options_.map_crs = crs;
    return Complaint([&] { ReadSite(inputs_, options_); });
  };
  WriteWithOgr(folder_ / "metres.shp", "ESRI Shapefile", "", Row());
  EXPECT_THAT(complaint("metres.shp", ""),
              AllOf(HasSubstr("names no coordinate system"), HasSubstr("--map-crs EPSG:25832")));
  EXPECT_EQ(complaint("metres.shp", "EPSG:32633"), "");
  EXPECT_THAT(complaint("metres.shp", "EPSG:4326"), HasSubstr("has degrees, but"));
  EXPECT_THAT(complaint("metres.shp", "EPSG:999999"),
              HasSubstr("no coordinate system on the earth"));
  // The same with degrees: a Shapefile that lost its .prj.
  WriteWithOgr(folder_ / "degrees.shp", "ESRI Shapefile", "EPSG:4326", Row());
  std::filesystem::remove(folder_ / "degrees.prj");
  EXPECT_THAT(complaint("degrees.shp", ""),
              AllOf(HasSubstr("look like degrees"), HasSubstr("--map-crs EPSG:4326")));
  EXPECT_EQ(complaint("degrees.shp", "EPSG:4326"), "");
  // GeoJSON has degrees by definition; other programs write metres all the same.
  WriteFile(folder_ / "metres.geojson",
            R"({"type":"FeatureCollection","features":[{"type":"Feature","properties":{"height":9},
               "geometry":{"type":"Polygon","coordinates":[[[457000,5550000],[457020,5550000],
               [457020,5550010],[457000,5550010],[457000,5550000]]]}}]})");
  EXPECT_THAT(complaint("metres.geojson", ""), HasSubstr("look like metres"));
  EXPECT_EQ(complaint("metres.geojson", "EPSG:32633"), "");
}

TEST_F(ReadSiteTest, MapWithoutUsableBuildings) {
  EXPECT_THAT(ComplaintAbout({House(1, Rectangle(0, 0, 0.5, 0.5))}),
              HasSubstr("no building of a usable size"));
}

TEST_F(ReadSiteTest, ManyRepairsAreSummedUp) {
  std::vector<MadeBuilding> buildings;
  for (int i = 0; i < 30; ++i) {
    buildings.push_back(
        House(i + 1, {{30. * i, 0}, {30. * i + 10, 10}, {30. * i + 10, 0}, {30. * i, 10}}));
  }
  EXPECT_THAT(Read(buildings).repairs,
              testing::ElementsAre(
                  "30 buildings (B0001, B0002, B0003, ...): contour crosses itself; repaired"));
}

// Ground that rises 1 m in 10 m towards the east, in the metres of made maps.
double Slope(double x, double) {
  return 250 + 0.1 * x;
}

TEST_F(ReadSiteTest, TerrainLiftsBuildingsAndCeiling) {
  inputs_.dem = folder_ / "dem.tif";
  WriteDem(*inputs_.dem, {}, Slope);
  const Site site = Read(Row());
  EXPECT_NEAR(site.origin.height_m, 257, 0.1);  // 70 m east of the place
  EXPECT_NEAR(site.terrain.HeightAt({0, 0}), 0, 1e-3);
  EXPECT_NEAR(site.terrain.HeightAt(In(site, 100, 40)), 3, 0.05);
  EXPECT_EQ(site.terrain.step_m, 2);
  EXPECT_NEAR(site.footprints[0].z_m.from_m, -7, 0.05);
  EXPECT_NEAR(site.footprints[2].z_m.to_m, 15, 0.05);
  EXPECT_NEAR(site.facades[0].z_m.from_m, -7, 0.05);
  EXPECT_NEAR(site.CeilingAt(In(site, 70, 6)), 23, 1);
  EXPECT_NEAR(site.FloorAt(In(site, 0, 0)), -2, 0.05);
}

TEST_F(ReadSiteTest, TerrainMayBeInDegreesAndCoarse) {
  inputs_.dem = folder_ / "dem.tif";
  WriteDem(*inputs_.dem, {.crs = "EPSG:4326", .pixels = 100, .step = 1.0 / 3600 / 3}, Slope);
  const Site site = Read(Row());
  EXPECT_NEAR(site.terrain.step_m, 6.6, 0.1);  // a third of a second of longitude
  EXPECT_NEAR(site.origin.height_m, 257, 0.1);
  for (const double x : {-20., 0., 33., 150.}) {
    EXPECT_NEAR(site.terrain.HeightAt(In(site, x, 20)), 0.1 * x - 7, 0.05);
  }
}

// Heights count from the take-off: it is on the ground, not on what covers the ridges beside it.
TEST_F(ReadSiteTest, HomeBesideRidgesIsOnTheGround) {
  inputs_.dem = folder_ / "dem.tif";
  WriteDem(*inputs_.dem, {}, [](double x, double) { return x > 55 && x < 60 ? 290 : 250; });
  inputs_.home = AsText({53, -30});
  const Site site = Read(Row());
  EXPECT_NEAR(site.home.z(), 250 - site.origin.height_m, 0.01);
  EXPECT_GT(site.terrain.HeightAt(site.home.head<2>()) - site.home.z(), 1);
}

TEST_F(ReadSiteTest, TerrainGapsAreFilled) {
  inputs_.dem = folder_ / "dem.tif";
  WriteDem(*inputs_.dem, {.pixels = 400, .step = 2}, [](double x, double y) {
    return std::hypot(x - 70, y - 6) < 25 ? std::nan("") : Slope(x, y);
  });
  const Site site = Read(Row());
  EXPECT_NEAR(site.origin.height_m, 257, 0.5);
  EXPECT_THAT(site.repairs, testing::ElementsAre(HasSubstr("terrain: gaps (")));
  for (const float z : site.terrain.z_m) EXPECT_TRUE(std::isfinite(z));
}

TEST_F(ReadSiteTest, TerrainMustCoverTheSite) {
  inputs_.dem = folder_ / "dem.tif";
  WriteDem(*inputs_.dem, {.pixels = 200}, Slope);
  // The area ends 160 m east of the place, the terrain 100 m.
  EXPECT_THAT(ComplaintAbout(Row()),
              AllOf(HasSubstr("does not cover the site"), HasSubstr("60 m are missing")));
  WriteDem(*inputs_.dem, {}, [](double, double) { return std::nan(""); });
  EXPECT_THAT(ComplaintAbout(Row()), HasSubstr("has no heights"));
  WriteFile(*inputs_.dem, "no tiff");
  EXPECT_THAT(ComplaintAbout(Row()), HasSubstr("cannot be read as a raster"));
}

}  // namespace
}  // namespace stucco::plan
