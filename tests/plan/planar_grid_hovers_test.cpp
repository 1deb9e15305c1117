// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "plan/planar/grid_hovers.h"
#include "survey/error.h"
#include "survey/geometry2d.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

Site Block(MadeSiteOptions options = {}) {
  options.safe_altitude_m = 30;
  options.heights_m = {12};
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 60, 30)}, options);
}

TEST(GridHovers, AreSpacedByTheOverlaps) {
  const Site site = Block();  // an area of 180 m by 150 m
  const CameraPreset camera = FindCamera("mavic-3e");
  const GridOptions options{.forward_overlap = 0.75, .side_overlap = 0.5};
  const GridStep step = StepOf(site, camera, options);
  EXPECT_NEAR(step.forward_m, 0.25 * camera.HeightAt(30), 1e-9);
  EXPECT_NEAR(step.side_m, 0.5 * camera.WidthAt(30), 1e-9);
  const std::vector<Hover> hovers = GridHovers(site, camera, options);
  const int columns = static_cast<int>(180 / step.forward_m) + 1;
  const int lines = static_cast<int>(150 / step.side_m) + 1;
  ASSERT_EQ(hovers.size(), static_cast<size_t>(columns * lines));
  // Neighbours in order are one step apart, at the turns too.
  for (size_t i = 1; i < hovers.size(); ++i) {
    const double distance = (hovers[i].position - hovers[i - 1].position).norm();
    EXPECT_NEAR(distance, i % columns == 0 ? step.side_m : step.forward_m, 1e-9);
  }
  // As far from the west border as from the east.
  EXPECT_NEAR(hovers.front().position.x() + 60, 120 - hovers[columns - 1].position.x(), 1e-9);
}

TEST(GridHovers, TakeFivePhotosAlongAndAcrossTheLines) {
  const std::vector<Hover> hovers = GridHovers(Block(), FindCamera("mavic-3e"), {});
  ASSERT_FALSE(hovers.empty());
  for (const Hover& hover : hovers) {
    ASSERT_EQ(hover.shots.size(), 5U);
    EXPECT_EQ(hover.position.z(), 30);
    EXPECT_EQ(hover.shots[0].kind, ViewKind::kNadir);
    EXPECT_NEAR(hover.shots[0].pitch_rad, -std::numbers::pi / 2, 1e-12);
    for (int k = 1; k < 5; ++k) {
      EXPECT_EQ(hover.shots[k].kind, ViewKind::kOblique);
      EXPECT_NEAR(hover.shots[k].pitch_rad, -std::numbers::pi / 4, 1e-12);
      EXPECT_NEAR(std::remainder(hover.shots[k].yaw_rad -
                                     (std::numbers::pi / 2 + (k - 1) * std::numbers::pi / 2),
                                 2 * std::numbers::pi),
                  0, 1e-9);
    }
  }
}

TEST(GridHovers, StayInTheAreaAndOutOfNoFlyPolygons) {
  const Ring tower = Rectangle(20, 40, 45, 70);
  Site site = Block({.no_fly = {{{tower}}}});
  site.area = {{{{-40, -40}, {100, -20}, {80, 90}, {-30, 70}}}};
  const std::vector<Hover> hovers = GridHovers(site, FindCamera("mavic-3e"), {});
  site.no_fly.clear();
  EXPECT_LT(hovers.size(), GridHovers(site, FindCamera("mavic-3e"), {}).size());
  for (const Hover& hover : hovers) {
    EXPECT_TRUE(Contains(site.area, hover.position.head<2>()));
    EXPECT_FALSE(Contains(tower, hover.position.head<2>()));
  }
}

TEST(GridHovers, FollowTheCeiling) {
  TerrainGrid slope{.corner = {-100, -100}, .step_m = 50, .columns = 8, .rows = 8, .z_m = {}};
  for (int i = 0; i < 64; ++i) slope.z_m.push_back(static_cast<float>(5 * (i % 8)));
  const Site site = Block({.terrain = slope});
  for (const Hover& hover : GridHovers(site, FindCamera("mavic-3e"), {})) {
    EXPECT_EQ(hover.position.z(), site.CeilingAt(hover.position.head<2>()));
  }
}

TEST(GridHovers, ASmallAreaHasOne) {
  Site site = Block();
  site.area = {{Rectangle(28, 13, 32, 16)}};
  const std::vector<Hover> hovers = GridHovers(site, FindCamera("mavic-3e"), {});
  ASSERT_EQ(hovers.size(), 1U);
  EXPECT_NEAR((hovers[0].position - Eigen::Vector3d(30, 14.5, 30)).norm(), 0, 1e-9);
  site.area = {};
  EXPECT_TRUE(GridHovers(site, FindCamera("mavic-3e"), {}).empty());
}

TEST(GridHovers, AnAreaOfACountryIsRefused) {
  Site site = Block();
  site.area = {{Rectangle(0, 0, 300000, 300000)}};
  try {
    GridHovers(site, FindCamera("mavic-3e"), {});
    FAIL();
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
    EXPECT_FALSE(error.remedy().empty());
  }
}

// A tower of 50 m and a house of 12 m below a ceiling of 60 m.
Site TowerAndHouse(std::vector<double> heights_m = {50, 12}) {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 15), Rectangle(60, 0, 80, 15)},
                  {.heights_m = std::move(heights_m)});
}

TEST(FinerAbove, IsMoreTheNearerTheRoofIsToTheCeiling) {
  const Site site = TowerAndHouse();
  const GridOptions options{.forward_overlap = 0.8, .side_overlap = 0.8};
  EXPECT_EQ(FinerAbove(site, site.footprints[0], options), 4);  // 10 m below: 1.2 of a photo
  EXPECT_EQ(FinerAbove(site, site.footprints[1], options), 1);
  const Site middle = TowerAndHouse({36, 12});
  EXPECT_EQ(FinerAbove(middle, middle.footprints[0], options), 2);
  // No more overlap than was asked for.
  EXPECT_EQ(FinerAbove(middle, middle.footprints[0], {.forward_overlap = 0.5, .side_overlap = 0.8}),
            4);
  EXPECT_EQ(FinerAbove(middle, middle.footprints[1], {.forward_overlap = 0, .side_overlap = 0}), 2);
}

TEST(FinerAbove, AsksNothingOfRoofsWhoseHeightIsNotKnown) {
  const Site site = TowerAndHouse({0, 12});
  EXPECT_EQ(FinerAbove(site, site.footprints[0], {}), 1);
  EXPECT_TRUE(HoversAboveHighRoofs(site, FindCamera("mavic-3e"), {}).empty());
}

TEST(HoversAboveHighRoofs, StandBetweenThoseOfTheGridAndNearTheTower) {
  const Site site = TowerAndHouse();
  const CameraPreset camera = FindCamera("mavic-3e");
  const std::vector<Hover> grid = GridHovers(site, camera, {});
  const std::vector<Hover> more = HoversAboveHighRoofs(site, camera, {});
  const GridStep step = StepOf(site, camera, {});
  // 20 m x 15 m and 10 m around, less what is of the grid.
  EXPECT_GT(static_cast<double>(more.size()) * step.forward_m * step.side_m / 16, 900);
  EXPECT_LT(static_cast<double>(more.size()) * step.forward_m * step.side_m / 16, 1600);
  for (const Hover& hover : more) {
    EXPECT_EQ(hover.position.z(), 60);
    EXPECT_EQ(hover.shots.size(), 5U);
    EXPECT_LE(Distance(site.footprints[0].outline, hover.position.head<2>()), 20);
    double nearest = 1000;
    for (const Hover& other : grid) {
      nearest = std::min(nearest, (other.position - hover.position).norm());
    }
    EXPECT_GT(nearest, 0.2 * step.forward_m);
  }
}

TEST(HoversAboveHighRoofs, StayOutOfNoFlyPolygons) {
  const std::vector<Ring> rings{Rectangle(0, 0, 20, 15)};
  const Site site =
      MadeSite(rings, {.heights_m = {50}, .no_fly = {{{Rectangle(-30, -30, 10, 40)}}}});
  const std::vector<Hover> more = HoversAboveHighRoofs(site, FindCamera("mavic-3e"), {});
  EXPECT_FALSE(more.empty());
  for (const Hover& hover : more) EXPECT_GE(hover.position.x(), 10);
}

}  // namespace
}  // namespace stucco::plan
