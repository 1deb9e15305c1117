// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/map/read_obstacles.h"
#include "plan/map/read_site.h"
#include "plan/space/obstacles.h"
#include "site/facades.h"
#include "survey/files.h"
#include "survey/geometry2d.h"
#include "tests/plan/made_map.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::AllOf;
using testing::HasSubstr;

MadeBuilding Thing(const Ring& ring, const std::string& height) {
  MadeBuilding thing{{{ring}}, {}};
  if (!height.empty()) thing.attributes["height"] = height;
  return thing;
}

class ObstaclesTest : public testing::Test {
 protected:
  // One house of 20 x 12 m and 8 m height, and obstacles around it.
  Site Read(const std::vector<MadeBuilding>& obstacles) {
    WriteGeoJson(folder_ / "map.geojson", {Thing(Rectangle(0, 0, 20, 12), "8")});
    WriteGeoJson(folder_ / "obstacles.geojson", obstacles);
    return ReadSite({.map = folder_ / "map.geojson", .obstacles = folder_ / "obstacles.geojson"},
                    options_);
  }
  std::string ComplaintAbout(const std::vector<MadeBuilding>& obstacles) {
    return Complaint([&] { Read(obstacles); });
  }
  // A position of made maps in the frame of a site.
  static Eigen::Vector3d At(const Site& site, double x, double y, double z) {
    const auto p = PlanFromGeodetic(site.origin, GeodeticFromPlan(OriginNear(kMadePlace), {x, y}));
    return {p.x(), p.y(), z};
  }

  test::TemporaryFolder folder_;
  PlanOptions options_;
};

TEST_F(ObstaclesTest, KeepFlightsAwayAndHaveNoFacades) {
  options_.altitude_m = 40;
  const Site site = Read({Thing(Rectangle(40, 0, 46, 6), "15")});
  ASSERT_EQ(site.footprints.size(), 2u);
  const Footprint& tree = site.footprints[1];
  EXPECT_EQ(tree.building, "O0001");
  EXPECT_TRUE(tree.is_obstacle);
  EXPECT_FALSE(tree.in_area);
  EXPECT_EQ(tree.z_m, (Interval{0, 15}));
  EXPECT_EQ(tree.blocked_to_m, 25);
  EXPECT_EQ(site.facades.size(), 4u);
  const Obstacles space(site);
  EXPECT_FALSE(space.IsFree(At(site, 55.9, 3, 24.9)));
  EXPECT_TRUE(space.IsFree(At(site, 56.2, 3, 24.9)));
  EXPECT_TRUE(space.IsFree(At(site, 43, 3, 25.1)));
}

TEST_F(ObstaclesTest, RaiseTheSafeAltitude) {
  EXPECT_EQ(Read({Thing(Rectangle(40, 0, 46, 6), "15")}).safe_altitude_m, 25);
  EXPECT_EQ(Read({Thing(Rectangle(40, 0, 46, 6), "5")}).safe_altitude_m, 18);
}

TEST_F(ObstaclesTest, AltitudesBelowThemAreRefused) {
  options_.altitude_m = 30;
  EXPECT_THAT(ComplaintAbout({Thing(Rectangle(40, 0, 46, 6), "35")}),
              AllOf(HasSubstr("obstacle O0001 is 35.0 m high"), HasSubstr("--altitude 45"),
                    HasSubstr("--no-fly")));
  EXPECT_THAT(ComplaintAbout({Thing(Rectangle(40, 0, 46, 6), "999")}),
              AllOf(HasSubstr("obstacle O0001"), HasSubstr("check the unit")));
}

TEST_F(ObstaclesTest, WithoutAHeightReachTheSafeAltitude) {
  for (const char* height : {"", "0", "tall", "-3"}) {
    options_.altitude_m = 0;
    EXPECT_THAT(ComplaintAbout({Thing(Rectangle(40, 0, 46, 6), height)}),
                AllOf(HasSubstr("1 of 1 obstacles have no height"), HasSubstr("--no-fly")));
    options_.altitude_m = 40;
    EXPECT_EQ(Read({Thing(Rectangle(40, 0, 46, 6), height)}).footprints[1].blocked_to_m, 40);
  }
}

// Footprints must not cross; together they still forbid all that each obstacle forbids.
TEST_F(ObstaclesTest, GiveWayToBuildingsAndHigherOnes) {
  options_.altitude_m = 60;
  const Site site = Read({Thing(Rectangle(15, 4, 30, 8), "20"),      // over the east wall
                          Thing(Rectangle(25, 5, 40, 7), "30"),      // higher, over the first
                          Thing(Rectangle(5, 5, 5.5, 5.5), "25")});  // a mast on the roof
  ASSERT_EQ(site.footprints.size(), 3u);
  EXPECT_EQ(site.footprints[0].blocked_to_m, 35);
  EXPECT_EQ(site.facades.size(), 4u);
  for (size_t i = 0; i < 3; ++i) {
    for (size_t j = 0; j < i; ++j) {
      for (const Ring& ring : site.footprints[i].outline.rings) {
        for (const Eigen::Vector2d& corner : ring) {
          EXPECT_GT(Distance(site.footprints[j].outline, corner), kSnap_m);
        }
      }
    }
  }
  const Obstacles space(site);
  EXPECT_FALSE(space.IsFree(At(site, 17, 6, 29)));
  EXPECT_FALSE(space.IsFree(At(site, 5, 21, 34)));
  EXPECT_TRUE(space.IsFree(At(site, 5, 21, 36)));
  EXPECT_FALSE(space.IsFree(At(site, 22, 17, 29)));
  EXPECT_FALSE(space.IsFree(At(site, 27, 16, 39)));
}

TEST_F(ObstaclesTest, ManyCrossingOnesComeApart) {
  std::vector<MadeBuilding> trees;
  for (int i = 0; i < 60; ++i) {
    const double x = 25 + i % 10 * 4;
    const double y = -10 + i / 10 * 4;
    trees.push_back(Thing(Rectangle(x, y, x + 6, y + 6), fmt::format("{}", 5 + i * 7 % 11)));
  }
  options_.altitude_m = 40;
  const Site site = Read(trees);
  const Obstacles space(site);
  const auto forbids = [&](const Eigen::Vector2d& at, double height) {
    return !space.IsFree(At(site, at.x(), at.y(), height + options_.d_min_m - 0.01));
  };
  for (int i = 0; i < 60; ++i) {
    const Ring& ring = trees[static_cast<size_t>(i)].outline.rings[0];
    const Eigen::Vector2d middle = (ring[0] + ring[2]) / 2;
    EXPECT_TRUE(forbids(middle, 5 + i * 7 % 11)) << i;
    EXPECT_TRUE(forbids(ring[0] - Eigen::Vector2d(6.8, 6.8), 5 + i * 7 % 11)) << i;
  }
}

TEST_F(ObstaclesTest, PointsAndLinesAreAsThickAsTheySay) {
  WriteGeoJson(folder_ / "map.geojson", {Thing(Rectangle(0, 0, 20, 12), "8")});
  const auto place = [](double x, double y) {
    const Geodetic at = GeodeticFromPlan(OriginNear(kMadePlace), {x, y});
    return fmt::format("[{:.9f},{:.9f}]", at.longitude_deg, at.latitude_deg);
  };
  WriteFile(folder_ / "obstacles.geojson",
            fmt::format(R"({{"type":"FeatureCollection","features":[
    {{"type":"Feature","properties":{{"height":"10","radius":"4"}},
      "geometry":{{"type":"Point","coordinates":{}}}}},
    {{"type":"Feature","properties":{{"height":"12","radius":"1"}},
      "geometry":{{"type":"LineString","coordinates":[{},{},{}]}}}}]}})",
                        place(40, 0), place(60, 0), place(60, 40), place(90, 40)));
  const Site site = ReadSite(
      {.map = folder_ / "map.geojson", .obstacles = folder_ / "obstacles.geojson"}, options_);
  ASSERT_EQ(site.footprints.size(), 3u);
  const auto distance = [&](size_t i, double x, double y) {
    return Distance(site.footprints[i].outline, Eigen::Vector2d(At(site, x, y, 0).head<2>()));
  };
  EXPECT_EQ(site.footprints[1].z_m.to_m, 12);  // the higher one first
  EXPECT_EQ(distance(1, 60.9, 20), 0);
  EXPECT_NEAR(distance(1, 65, 20), 4, 0.05);
  EXPECT_NEAR(distance(1, 75, 45), 4, 0.05);
  EXPECT_EQ(distance(2, 42.8, 2.8), 0);
  EXPECT_NEAR(distance(2, 40, 14), 10, 0.1);
}

}  // namespace
}  // namespace stucco::plan
