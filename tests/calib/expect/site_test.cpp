// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/site.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "survey/occluders.h"
#include "tests/calib/expect/made_site.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

const Eigen::AlignedBox2d kEverywhere(Eigen::Vector2d(-1000, -1000), Eigen::Vector2d(1000, 1000));

TEST(SampleSite, PutsPointsOnWallsRoofsAndGround) {
  int walls = 0;
  int roofs = 0;
  int ground = 0;
  for (const SitePoint& p : SampleSite(TwoHouses(), 2, kEverywhere)) {
    EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
    if (p.wall >= 0) {
      ++walls;
      EXPECT_GT(p.position.z(), 0);
      EXPECT_LT(p.position.z(), 12);
    } else if (p.position.z() > 6) {
      ++roofs;
      EXPECT_NEAR(p.position.z(), 12, 0.1);
    } else {
      ++ground;
      EXPECT_NEAR(p.position.z(), 0, 0.1);
    }
    if (p.wall == 0) {
      EXPECT_LT((p.normal - Vector3d(0, -1, 0)).norm(), 1e-12);
      EXPECT_NEAR(p.position.y(), 0, 0.1);
    }
  }
  EXPECT_EQ(walls, 2 * (60 / 2) * (12 / 2));
  EXPECT_NEAR(roofs, 2 * 50, 10);
  EXPECT_NEAR(ground, 80 * 120 / 4 - roofs, 100);
}

TEST(SampleSite, LaysTheGroundAtTheFootOfTheNearestHouse) {
  Plan plan = TwoHouses();
  plan.footprints[1].z_m = {5, 17};
  for (const SitePoint& p : SampleSite(plan, 2, kEverywhere)) {
    if (p.wall >= 0 || p.position.z() > 10) continue;
    if (std::abs(p.position.y() + 20) < 5) continue;  // half way
    EXPECT_NEAR(p.position.z(), p.position.y() > -20 ? 0 : 5, 0.1) << p.position.transpose();
  }
}

TEST(SampleSite, KeepsToTheArea) {
  const Eigen::AlignedBox2d area(Eigen::Vector2d(5, -10), Eigen::Vector2d(15, 5));
  int walls = 0;
  for (const SitePoint& p : SampleSite(TwoHouses(), 2, area)) {
    EXPECT_TRUE(area.contains(p.position.head<2>()) || p.wall < 0);
    EXPECT_LT(area.exteriorDistance(p.position.head<2>()), 2) << p.position.transpose();
    walls += p.wall == 0;
    EXPECT_LE(p.wall, 0);
  }
  EXPECT_EQ(walls, 6 * (12 / 2));  // 5, 7 ... 15 m along
  EXPECT_TRUE(SampleSite(TwoHouses(), 2, Eigen::AlignedBox2d()).empty());
}

TEST(SampleSite, LetsWallsFollowEachOther) {
  int wall = 0;
  for (const SitePoint& p : SampleSite(TwoHouses(), 2, kEverywhere)) {
    if (p.wall < 0) continue;
    EXPECT_GE(p.wall, wall);
    wall = p.wall;
  }
  EXPECT_EQ(wall, 7);
}

TEST(SampleSite, TakesTheGroundFromASmallHutToo) {
  Plan plan = TwoHouses();
  // Less than a cell wide, far from the houses, 4 m higher.
  plan.footprints.push_back(
      {"B0003", {{{100.2, -20}, {100.8, -20}, {100.8, -19.5}, {100.2, -19.5}}}, {4, 6}, 6});
  bool any = false;
  for (const SitePoint& p : SampleSite(plan, 2, kEverywhere)) {
    if (p.wall >= 0 || (p.position.head<2>() - Eigen::Vector2d(100, -20)).norm() > 10) continue;
    EXPECT_NEAR(p.position.z(), 4, 0.1);
    any = true;
  }
  EXPECT_TRUE(any);
}

TEST(SampleSite, SamplesWallsWithoutAFootprint) {
  Plan plan = TwoHouses();
  plan.footprints.clear();
  const auto points = SampleSite(plan, 2, kEverywhere);
  EXPECT_EQ(points.size(), 2u * (60 / 2) * (12 / 2));
}

TEST(SampleSite, SurvivesAPlanWithoutBuildings) {
  EXPECT_TRUE(SampleSite(Plan{}, 2, kEverywhere).empty());
  EXPECT_TRUE(MeshOfSite(Plan{}).triangles.empty());
}

TEST(MeshOfSite, StopsRaysAtWallsRoofsAndGround) {
  const SiteMesh mesh = MeshOfSite(TwoHouses());
  const Occluders site(mesh.vertices, mesh.triangles);
  EXPECT_NEAR(site.FirstHit({10, -20, 6}, {0, 1, 0}).value_or(-1), 20, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, 5, 40}, {0, 0, -1}).value_or(-1), 28, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, -20, 40}, {0, 0, -1}).value_or(-1), 40, 1e-4);
  EXPECT_NEAR(site.FirstHit({150, 5, 40}, {0, 0, -1}).value_or(-1), 40, 1e-4);  // far around
  EXPECT_FALSE(site.FirstHit({10, -20, 6}, {1, 0, 0.1}));                       // the sky
}

TEST(MeshOfSite, LeavesCourtyardsOpen) {
  Plan plan = TwoHouses();
  plan.footprints[0].rings_m.push_back({{5, 3}, {5, 7}, {15, 7}, {15, 3}});
  const SiteMesh mesh = MeshOfSite(plan);
  const Occluders site(mesh.vertices, mesh.triangles);
  EXPECT_GT(site.FirstHit({10, 5, 40}, {0, 0, -1}).value_or(-1), 30);
  EXPECT_NEAR(site.FirstHit({10, 1, 40}, {0, 0, -1}).value_or(-1), 28, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, 5, 6}, {1, 0, 0}).value_or(-1), 5, 1e-4);
}

}  // namespace
}  // namespace stucco::test
