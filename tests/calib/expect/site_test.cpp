// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/site.h"

#include <gtest/gtest.h>

#include <cmath>

#include "survey/occluders.h"
#include "tests/calib/expect/made_site.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

TEST(SampleSite, PutsPointsOnWallsRoofsAndGround) {
  int walls = 0;
  int roofs = 0;
  int ground = 0;
  for (const SitePoint& p : SampleSite(TwoHouses(), 2)) {
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
  for (const SitePoint& p : SampleSite(plan, 2)) {
    if (p.wall >= 0 || p.position.z() > 10) continue;
    if (std::abs(p.position.y() + 20) < 5) continue;  // half way
    EXPECT_NEAR(p.position.z(), p.position.y() > -20 ? 0 : 5, 0.1) << p.position.transpose();
  }
}

TEST(SampleSite, SurvivesAPlanWithoutBuildings) {
  EXPECT_TRUE(SampleSite(Plan{}, 2).empty());
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
