// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

#include "plan/space/obstacles.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

Ring Rectangle(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

Ring Reversed(Ring ring) {
  return {ring.rbegin(), ring.rend()};
}

Footprint Building(std::vector<Ring> rings, double blocked_to) {
  Footprint footprint;
  footprint.outline.rings = std::move(rings);
  footprint.blocked_to_m = blocked_to;
  return footprint;
}

// A block of 100 x 100 m around a courtyard of 60 x 60 m, blocked to 30 m, a hut of 10 x 10 m at
// (200, 0), blocked to 15 m, and a no-fly square of 20 m at (0, 200). d_min 10 m.
Site SiteOfObstacles() {
  Site site;
  site.footprints.push_back(
      Building({Rectangle(0, 0, 100, 100), Reversed(Rectangle(20, 20, 80, 80))}, 30));
  site.footprints.push_back(Building({Rectangle(200, 0, 210, 10)}, 15));
  site.no_fly.push_back({{Rectangle(0, 200, 20, 220)}});
  site.d_min_m = 10;
  site.min_altitude_m = 5;
  site.safe_altitude_m = 30;
  return site;
}

TEST(Obstacles, KeepsDistanceFromWalls) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFree(Vector3d(-10.002, 50, 10)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(-10.0, 50, 10)));  // the border is not free
  EXPECT_FALSE(obstacles.IsFree(Vector3d(-9.9, 50, 10)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(10, 50, 10)));  // inside
  // Around a corner the distance is to the corner.
  const double side = 10.002 * std::sqrt(0.5);
  EXPECT_TRUE(obstacles.IsFree(Vector3d(-side, -side, 10)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(-side + 0.01, -side, 10)));
}

TEST(Obstacles, CourtyardsAreFreeInTheMiddle) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFree(Vector3d(50, 50, 10)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(29, 50, 10)));
  EXPECT_DOUBLE_EQ(obstacles.HorizontalDistance({50, 50}, 10), 30);
}

TEST(Obstacles, EndWhereTheyAreBlockedTo) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFree(Vector3d(10, 50, 30)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(10, 50, std::nextafter(30.0, 0.0))));
  EXPECT_TRUE(obstacles.IsFree(Vector3d(205, 5, 15)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(205, 5, 14)));
}

TEST(Obstacles, NoFlyPolygonsReachTheSky) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_FALSE(obstacles.IsFree(Vector3d(10, 210, 1000)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(0, 210, 1000)));
  EXPECT_TRUE(obstacles.IsFree(Vector3d(-0.01, 210, 10)));
  EXPECT_FALSE(obstacles.IsFreeBetween({-5, 210, 500}, {30, 211, 500}));
}

TEST(Obstacles, VerticalSequencesAreAsFreeAsTheirLowestPoint) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFree(Vector2d(-11, 50), {5, 40}));
  EXPECT_FALSE(obstacles.IsFree(Vector2d(-11, 50), {4, 40}));
  EXPECT_TRUE(obstacles.IsFree(Vector2d(10, 50), {30, 40}));
  EXPECT_FALSE(obstacles.IsFree(Vector2d(10, 50), {29, 40}));
}

TEST(Obstacles, SegmentsCountOnlyBelowTheTop) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFreeBetween({-11, -50, 10}, {-11, 150, 10}));
  EXPECT_FALSE(obstacles.IsFreeBetween({-9, -50, 10}, {-9, 150, 10}));
  EXPECT_FALSE(obstacles.IsFreeBetween({-50, 50, 10}, {150, 50, 10}));
  EXPECT_TRUE(obstacles.IsFreeBetween({-50, 50, 30}, {150, 50, 30}));
  // Falls below the top 10 m west of the hut's wall: exactly at the border, and just outside it.
  EXPECT_TRUE(obstacles.IsFreeBetween({205, 5, 15}, {185, 5, 15}));
  EXPECT_FALSE(obstacles.IsFreeBetween({205, 5, 15}, {185, 5, 14.9}));
  EXPECT_FALSE(obstacles.IsFreeBetween({205, 5, 16}, {180, 5, 11}));
  EXPECT_TRUE(obstacles.IsFreeBetween({205, 5, 20}, {180, 5, 14}));
}

TEST(Obstacles, CornersBesideADiagonalCount) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  // Passes the block's corner (0, 0) at 9.9 and 10.1 m.
  for (const auto& [distance, free] : {std::pair{9.9, false}, std::pair{10.1, true}}) {
    const double offset = distance * std::sqrt(2.0);
    EXPECT_EQ(obstacles.IsFreeBetween({-offset - 50, 50, 10}, {50, -offset - 50, 10}), free);
  }
}

TEST(Obstacles, NoFootprintsIsAllSky) {
  const Site site;
  const Obstacles obstacles(site);
  EXPECT_TRUE(obstacles.IsFree(Vector3d(0, 0, 5)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(0, 0, 4.9)));
  EXPECT_TRUE(std::isinf(obstacles.HorizontalDistance({0, 0}, 0)));
}

TEST(Obstacles, NothingIsFreeAtNan) {
  const Site site = SiteOfObstacles();
  const Obstacles obstacles(site);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(obstacles.IsFree(Vector3d(nan, 0, 50)));
  EXPECT_FALSE(obstacles.IsFree(Vector3d(0, 0, nan)));
  EXPECT_FALSE(obstacles.IsFreeBetween({-50, -50, 10}, {-50, nan, 10}));
}

// A ridge between two samples that are no higher than the ends of the segment.
TEST(Obstacles, SegmentsStayAboveTheTerrainBetween) {
  Site site;
  site.terrain.columns = 3;
  site.terrain.rows = 3;
  site.terrain.step_m = 10;
  site.terrain.z_m = {0, 20, 0, 0, 20, 0, 0, 20, 0};
  const Obstacles obstacles(site);
  EXPECT_FALSE(obstacles.IsFreeBetween({-30, 10, 10}, {50, 10, 10}));
  EXPECT_FALSE(obstacles.IsFreeBetween({-30, 10, 24.9}, {50, 10, 24.9}));
  EXPECT_TRUE(obstacles.IsFreeBetween({-30, 10, 25}, {50, 10, 25}));
  EXPECT_TRUE(obstacles.IsFreeBetween({0, 3, 5}, {0, 17, 5}));
  EXPECT_TRUE(obstacles.IsFreeBetween({10, -30, 25}, {10, 60, 25}));
}

// A saddle is highest along one diagonal of its cell, between samples.
TEST(Obstacles, TheFloorIsBilinearInsideACell) {
  Site site;
  site.terrain.columns = 2;
  site.terrain.rows = 2;
  site.terrain.step_m = 10;
  site.terrain.z_m = {0, 20, 20, 0};
  const Obstacles obstacles(site);
  EXPECT_FALSE(obstacles.IsFreeBetween({0, 0, 14}, {10, 10, 14}));  // 10 m of ground at (5, 5)
  EXPECT_TRUE(obstacles.IsFreeBetween({0, 0, 15}, {10, 10, 15}));
}

// Noise: dense sampling of random segments must agree, up to what sampling can miss.
TEST(Obstacles, SegmentsAgreeWithTheirPoints) {
  Site site = SiteOfObstacles();
  std::mt19937 random(7);
  std::uniform_real_distribution<double> at(-40, 240);
  std::uniform_real_distribution<double> height(6, 40);
  for (int k = 0; k < 40; ++k) {
    const double x = 260 + 40 * (k % 7);
    const double y = 50.0 * (k / 7);
    site.footprints.push_back(Building({{{x, y}, {x + 9, y + 3}, {x + 2, y + 11}}}, 10.0 + k));
  }
  const Obstacles obstacles(site);
  int free_segments = 0;
  for (int k = 0; k < 2000; ++k) {
    const Vector3d p(2 * at(random), at(random), height(random));
    const Vector3d q(2 * at(random), at(random), height(random));
    const bool free = obstacles.IsFreeBetween(p, q);
    free_segments += free;
    bool sampled = true;
    double nearest = std::numeric_limits<double>::infinity();
    for (int s = 0; s <= 2000; ++s) {
      const Vector3d point = p + s / 2000.0 * (q - p);
      sampled = sampled && obstacles.IsFree(point);
      nearest = std::min(nearest, obstacles.HorizontalDistance(point.head<2>(), point.z()));
    }
    EXPECT_TRUE(sampled || !free);
    EXPECT_TRUE(free || !sampled || nearest < 10.3) << nearest;
  }
  EXPECT_GT(free_segments, 100);
  EXPECT_LT(free_segments, 1900);
}

}  // namespace
}  // namespace stucco::plan
