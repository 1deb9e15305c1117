// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/baseline/dronescan.h"
#include "plan/planar/view_graph.h"
#include "plan/space/obstacles.h"
#include "site/sightings.h"
#include "survey/error.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kFarthestScan = 100;

Site Town() {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(45, 0, 60, 25),
                                    Rectangle(0, 24, 25, 40)},
                  {.safe_altitude_m = 26,
                   .margin_m = 26,
                   .heights_m = {8, 16, 11},
                   .no_fly = {{{Rectangle(30, -20, 36, -10)}}}});
}

std::vector<Hover> Views(const Site& site, int threads = 1) {
  return DroneScanViews(site, FindCamera("mavic-3e"), {.d_max_m = kFarthestScan}, threads,
                        SilentProgress());
}

TEST(DroneScanViews, AreSafeWithOnePhotoEach) {
  const Site site = Town();
  const Obstacles obstacles(site);
  const auto views = Views(site);
  EXPECT_GT(views.size(), 30U);
  for (const Hover& hover : views) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    ASSERT_EQ(hover.shots.size(), 1U);
    EXPECT_EQ(hover.shots[0].kind, ViewKind::kSurface);
    EXPECT_TRUE(hover.shots[0].targets.empty());
  }
}

// Where the line of sight meets the model nearest to the view distance.
TEST(DroneScanViews, FaceTheSurface) {
  const Site site = Town();
  const auto samples = SampleSurface(site, {.spacing_m = 1, .ground_reach_m = 20});
  for (const Hover& hover : Views(site)) {
    double off_axis = 1;
    for (const SurfaceSample& sample : samples) {
      const Eigen::Vector3d way = sample.position - hover.position;
      if (way.norm() > 40) continue;
      off_axis = std::min(off_axis, 1 - way.normalized().dot(hover.shots[0].Direction()));
    }
    EXPECT_LT(off_axis, 0.002);
  }
}

TEST(DroneScanViews, LeaveEverySurfaceThatCanBeSeenReconstructable) {
  const Site site = Town();
  const SurfaceView view(site, FindCamera("mavic-3e").Field(),
                         SampleSurface(site, {.spacing_m = 5, .ground_reach_m = 15}),
                         kFarthestScan);
  ViewGraph graph(view, kFarthestScan, 1);
  graph.AddAll(Views(site));
  int good = 0;
  for (const SampleState& state : graph.states()) good += state.reconstructability >= 1.5;
  EXPECT_GT(good, static_cast<int>(0.97 * graph.states().size()));
}

TEST(DroneScanViews, AreFarFewerThanTheirCandidates) {
  const Site site = Town();
  const auto samples = SampleSurface(
      site, {.spacing_m = 0.2 * FindCamera("mavic-3e").HeightAt(20), .ground_reach_m = 20});
  EXPECT_LT(Views(site).size(), samples.size() / 2);
}

TEST(DroneScanViews, RiseOutOfStreetsThatAreTooNarrow) {
  // 12 m between the walls leave no place within d_min = 10 m of both.
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 30, 20), Rectangle(0, 32, 30, 52)},
                             {.safe_altitude_m = 22, .heights_m = {12, 12}});
  const Obstacles obstacles(site);
  int above = 0;
  for (const Hover& hover : Views(site)) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    const Eigen::Vector3d& p = hover.position;
    above += p.x() > 0 && p.x() < 30 && p.y() > 20 && p.y() < 32 && p.z() >= 22;
  }
  EXPECT_GT(above, 0);
}

TEST(DroneScanViews, StandOnTheTerrain) {
  MadeSiteOptions made{.safe_altitude_m = 26, .margin_m = 26, .heights_m = {8, 16}};
  made.terrain = {.corner = {-60, -60}, .step_m = 10, .columns = 20, .rows = 20, .z_m = {}};
  for (int i = 0; i < 400; ++i) made.terrain.z_m.push_back(static_cast<float>(i % 20));
  const Site site =
      MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(45, 0, 60, 25)}, made);
  const Obstacles obstacles(site);
  const auto views = Views(site);
  EXPECT_GT(views.size(), 20U);
  for (const Hover& hover : views) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    EXPECT_GE(hover.position.z(), site.FloorAt(hover.position.head<2>()));
  }
}

TEST(DroneScanViews, AreTheSameAtAnyNumberOfThreads) {
  const Site site = Town();
  const auto one = Views(site, 1);
  const auto two = Views(site, 2);
  ASSERT_EQ(one.size(), two.size());
  for (size_t i = 0; i < one.size(); ++i) {
    EXPECT_EQ(one[i].position, two[i].position);
    EXPECT_EQ(one[i].shots[0].yaw_rad, two[i].shots[0].yaw_rad);
    EXPECT_EQ(one[i].shots[0].pitch_rad, two[i].shots[0].pitch_rad);
  }
}

TEST(DroneScanViews, OfNothingAreNone) {
  EXPECT_TRUE(Views(Site()).empty());
}

}  // namespace
}  // namespace stucco::plan
