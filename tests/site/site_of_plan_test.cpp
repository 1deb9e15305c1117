// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/site_of_plan.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "site/site_model.h"
#include "site/surface_samples.h"
#include "survey/occluders.h"
#include "tests/site/made_plan.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

const Eigen::AlignedBox2d kEverywhere(Eigen::Vector2d(-1000, -1000), Eigen::Vector2d(1000, 1000));

std::vector<SurfaceSample> Sampled(const Plan& plan, const Eigen::AlignedBox2d& within) {
  return SampleSurface(SiteOfPlan(plan), {.spacing_m = 2,
                                          .never_farther = true,
                                          .fewest_rows = 1,
                                          .ground_reach_m = 30,
                                          .off_surface_m = 0.05,
                                          .within = within});
}

TEST(SiteOfPlan, HasTheFootprintsAndFacadesOfThePlan) {
  Plan plan = TwoHouses();
  plan.facades[4].top_known = true;
  const Site site = SiteOfPlan(plan);
  EXPECT_EQ(site.ground, GroundRule::kNearestFoot);
  ASSERT_EQ(site.footprints.size(), 2u);
  EXPECT_EQ(site.footprints[1].building, "B0002");
  EXPECT_EQ(site.footprints[1].outline.rings, plan.footprints[1].rings_m);
  EXPECT_EQ(site.footprints[1].z_m, (Interval{0, 12}));
  ASSERT_EQ(site.facades.size(), 8u);
  for (size_t i = 0; i < 8; ++i) {
    EXPECT_EQ(site.facades[i].id, plan.facades[i].id);
    EXPECT_EQ(site.facades[i].footprint, static_cast<int>(i / 4));
    EXPECT_EQ(site.facades[i].normal(), plan.facades[i].outwards());
    EXPECT_EQ(site.facades[i].top_known, i == 4);
  }
}

TEST(SiteOfPlan, FindsThePartOfABuildingThatAFacadeIsAWallOf) {
  Plan plan = TwoHouses();
  // A tower on the second house, half as wide, with a wall above that of the house.
  plan.footprints.push_back({"B0002", {{{0, -50}, {10, -50}, {10, -40}, {0, -40}}}, {12, 20}, 20});
  PlannedFacade wall = plan.facades[4];
  wall.id = "B0002/F04";
  wall.b_m = {10, -50};
  wall.z_m = {12, 20};
  plan.facades.push_back(wall);
  wall.id = "B0002/F05";
  wall.a_m = {0, -70};
  wall.b_m = {10, -70};
  plan.facades.push_back(wall);
  const Site site = SiteOfPlan(plan);
  EXPECT_EQ(site.facades[4].footprint, 1);
  EXPECT_EQ(site.facades[8].footprint, 2);
  EXPECT_EQ(site.facades[9].footprint, -1);
  EXPECT_TRUE(site.footprints[2].in_area);
}

TEST(SiteOfPlan, TakesFootprintsWithoutFacadesForObstacles) {
  Plan plan = TwoHouses();
  plan.facades.resize(4);
  const Site site = SiteOfPlan(plan);
  EXPECT_TRUE(site.footprints[0].in_area);
  EXPECT_FALSE(site.footprints[1].in_area);
}

TEST(SiteOfPlan, GivesNoFlyPolygonsTheirHolesBack) {
  Plan plan;
  plan.no_fly_m = {{{0, 0}, {9, 0}, {9, 9}, {0, 9}},
                   {{3, 3}, {3, 6}, {6, 6}, {6, 3}},
                   {{20, 0}, {29, 0}, {29, 9}, {20, 9}}};
  const Site site = SiteOfPlan(plan);
  ASSERT_EQ(site.no_fly.size(), 2u);
  EXPECT_EQ(site.no_fly[0].rings.size(), 2u);
  EXPECT_EQ(Area(site.no_fly[0]), 81 - 9);
  EXPECT_EQ(Area(site.no_fly[1]), 81);
}

TEST(SiteOfPlan, PutsPointsOnWallsRoofsAndGround) {
  int walls = 0;
  int roofs = 0;
  int ground = 0;
  for (const SurfaceSample& p : Sampled(TwoHouses(), kEverywhere)) {
    EXPECT_NEAR(p.normal.norm(), 1, 1e-12);
    if (p.facade >= 0) {
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
    if (p.facade == 0) {
      EXPECT_LT((p.normal - Vector3d(0, -1, 0)).norm(), 1e-12);
      EXPECT_NEAR(p.position.y(), 0, 0.1);
    }
  }
  EXPECT_EQ(walls, 2 * (60 / 2) * (12 / 2));
  EXPECT_NEAR(roofs, 2 * 50, 10);
  EXPECT_NEAR(ground, 80 * 120 / 4 - roofs, 100);
}

TEST(SiteOfPlan, LaysTheGroundAtTheFootOfTheNearestHouse) {
  Plan plan = TwoHouses();
  plan.footprints[1].z_m = {5, 17};
  for (const SurfaceSample& p : Sampled(plan, kEverywhere)) {
    if (p.facade >= 0 || p.position.z() > 10) continue;
    if (std::abs(p.position.y() + 20) < 5) continue;  // half way
    EXPECT_NEAR(p.position.z(), p.position.y() > -20 ? 0 : 5, 0.1) << p.position.transpose();
  }
}

TEST(SiteOfPlan, KeepsToTheArea) {
  const Eigen::AlignedBox2d area(Eigen::Vector2d(5, -10), Eigen::Vector2d(15, 5));
  int walls = 0;
  for (const SurfaceSample& p : Sampled(TwoHouses(), area)) {
    EXPECT_TRUE(area.contains(p.position.head<2>()) || p.facade < 0);
    EXPECT_LT(area.exteriorDistance(p.position.head<2>()), 2) << p.position.transpose();
    walls += p.facade == 0;
    EXPECT_LE(p.facade, 0);
  }
  EXPECT_EQ(walls, 6 * (12 / 2));  // 5, 7 ... 15 m along
  EXPECT_TRUE(Sampled(TwoHouses(), Eigen::AlignedBox2d()).empty());
}

TEST(SiteOfPlan, LetsWallsFollowEachOther) {
  int wall = 0;
  for (const SurfaceSample& p : Sampled(TwoHouses(), kEverywhere)) {
    if (p.facade < 0) continue;
    EXPECT_GE(p.facade, wall);
    wall = p.facade;
  }
  EXPECT_EQ(wall, 7);
}

TEST(SiteOfPlan, TakesTheGroundFromASmallHutToo) {
  Plan plan = TwoHouses();
  // Less than a cell wide, far from the houses, 4 m higher.
  plan.footprints.push_back(
      {"B0003", {{{100.2, -20}, {100.8, -20}, {100.8, -19.5}, {100.2, -19.5}}}, {4, 6}, 6});
  bool any = false;
  for (const SurfaceSample& p : Sampled(plan, kEverywhere)) {
    if (p.facade >= 0 || (p.position.head<2>() - Eigen::Vector2d(100, -20)).norm() > 10) continue;
    EXPECT_NEAR(p.position.z(), 4, 0.1);
    any = true;
  }
  EXPECT_TRUE(any);
}

TEST(SiteOfPlan, SamplesWallsWithoutAFootprint) {
  Plan plan = TwoHouses();
  plan.footprints.clear();
  const auto points = Sampled(plan, kEverywhere);
  EXPECT_EQ(points.size(), 2u * (60 / 2) * (12 / 2));
}

TEST(SiteOfPlan, SurvivesAPlanWithoutBuildings) {
  EXPECT_TRUE(Sampled(Plan{}, kEverywhere).empty());
  EXPECT_FALSE(OccludersOf(SiteOfPlan(Plan{})).FirstHit({0, 0, 50}, {0, 0, -1}));
}

TEST(SiteOfPlan, StopsRaysAtWallsRoofsAndGround) {
  const Occluders site = OccludersOf(SiteOfPlan(TwoHouses()));
  EXPECT_NEAR(site.FirstHit({10, -20, 6}, {0, 1, 0}).value_or(-1), 20, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, 5, 40}, {0, 0, -1}).value_or(-1), 28, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, -20, 40}, {0, 0, -1}).value_or(-1), 40, 1e-4);
  EXPECT_NEAR(site.FirstHit({150, 5, 40}, {0, 0, -1}).value_or(-1), 40, 1e-4);  // far around
  EXPECT_FALSE(site.FirstHit({10, -20, 6}, {1, 0, 0.1}));                       // the sky
}

TEST(SiteOfPlan, LeavesCourtyardsOpen) {
  Plan plan = TwoHouses();
  plan.footprints[0].rings_m.push_back({{5, 3}, {5, 7}, {15, 7}, {15, 3}});
  const Occluders site = OccludersOf(SiteOfPlan(plan));
  EXPECT_GT(site.FirstHit({10, 5, 40}, {0, 0, -1}).value_or(-1), 30);
  EXPECT_NEAR(site.FirstHit({10, 1, 40}, {0, 0, -1}).value_or(-1), 28, 1e-4);
  EXPECT_NEAR(site.FirstHit({10, 5, 6}, {1, 0, 0}).value_or(-1), 5, 1e-4);
}

}  // namespace
}  // namespace stucco::test
