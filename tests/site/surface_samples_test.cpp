// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/surface_samples.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "survey/geometry2d.h"
#include "tests/site/made_site.h"

namespace stucco {
namespace {

size_t Count(const std::vector<SurfaceSample>& samples, SurfaceKind kind) {
  return static_cast<size_t>(std::ranges::count(samples, kind, &SurfaceSample::kind));
}

TEST(SurfaceSamples, WallsHaveRowsFromFootToTop) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 30, 20)}, {.heights_m = {12}});
  const auto samples = SampleSurface(site, {.spacing_m = 4});
  // 12 m make three rows; 30 m make eight columns and 20 m five.
  EXPECT_EQ(Count(samples, SurfaceKind::kWall), 2U * 3 * (8 + 5));
  for (const SurfaceSample& sample : samples) {
    if (sample.kind != SurfaceKind::kWall) continue;
    const Facade& facade = site.facades.at(sample.facade);
    const Eigen::Vector2d offset = sample.position.head<2>() - facade.a;
    EXPECT_NEAR(offset.dot(facade.normal()), 0, 1e-9);
    EXPECT_NEAR((sample.normal.head<2>() - facade.normal()).norm(), 0, 1e-12);
    EXPECT_GT(offset.dot(facade.along()), 1);
    EXPECT_LT(offset.dot(facade.along()), facade.length_m() - 1);
    EXPECT_GT(sample.position.z(), 1);
    EXPECT_LT(sample.position.z(), 11);
  }
}

TEST(SurfaceSamples, LowWallsHaveTwoRows) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 2, 2)}, {.heights_m = {3}});
  EXPECT_EQ(Count(SampleSurface(site, {.spacing_m = 8}), SurfaceKind::kWall), 8U);
}

TEST(SurfaceSamples, RoofsAreSampledWhereNothingStandsOnThem) {
  Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 40, 40)}, {.heights_m = {10}});
  EXPECT_EQ(Count(SampleSurface(site, {.spacing_m = 4}), SurfaceKind::kRoof), 100U);
  Footprint tower = site.footprints[0];
  tower.outline = {{Rectangle(8, 8, 16, 16)}};
  tower.z_m = {10, 20};
  site.footprints.push_back(tower);
  const auto samples = SampleSurface(site, {.spacing_m = 4});
  EXPECT_EQ(Count(samples, SurfaceKind::kRoof), 100U);
  EXPECT_EQ(std::ranges::count_if(samples,
                                  [](const SurfaceSample& s) {
                                    return s.kind == SurfaceKind::kRoof && s.position.z() == 20;
                                  }),
            4);
}

TEST(SurfaceSamples, TheSmallestRoofHasOne) {
  const Ring thin{{0.1, 0.1}, {0.6, 0.1}, {0.6, 0.4}, {0.1, 0.4}};
  const Site site = MadeSite(std::vector<Ring>{thin}, {.heights_m = {10}});
  const auto samples = SampleSurface(site, {.spacing_m = 5});
  ASSERT_EQ(Count(samples, SurfaceKind::kRoof), 1U);
  const auto roof = std::ranges::find(samples, SurfaceKind::kRoof, &SurfaceSample::kind);
  EXPECT_TRUE(Contains(thin, roof->position.head<2>()));
}

TEST(SurfaceSamples, GroundIsAroundTheBuildingsAndInsideTheArea) {
  Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 40, 40), Rectangle(200, 0, 240, 40)},
                       {.margin_m = 10, .heights_m = {10, 10}});
  site.footprints[1].in_area = false;  // an obstacle has no ground of its own
  const auto samples = SampleSurface(site, {.spacing_m = 4, .ground_reach_m = 20});
  // 10 m of margin at three sides, and 20 m towards the other house.
  const double area = 10 * 60 + 20 * 60 + 2 * 10 * 40;
  EXPECT_NEAR(16.0 * Count(samples, SurfaceKind::kGround), area, 0.15 * area);
  for (const SurfaceSample& sample : samples) {
    if (sample.kind != SurfaceKind::kGround) continue;
    const Eigen::Vector2d at = sample.position.head<2>();
    EXPECT_FALSE(Contains(site.footprints[0].outline, at));
    EXPECT_LE(Distance(site.footprints[0].outline, at), 20);
    EXPECT_TRUE(Contains(site.area, at));
    EXPECT_EQ(sample.position.z(), 0);
  }
  EXPECT_EQ(Count(samples, SurfaceKind::kRoof), 100U);
}

TEST(SurfaceSamples, AnEmptySiteHasNone) {
  EXPECT_TRUE(SampleSurface(Site(), {}).empty());
}

}  // namespace
}  // namespace stucco
