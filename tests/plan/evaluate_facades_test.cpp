// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/evaluate_facades.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plan/planar/grid_hovers.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kFarthest_m = 80;

const CameraPreset& Camera() {
  static const CameraPreset camera = FindCamera("mavic-3e");
  return camera;
}

std::vector<Hover> Assigned(const Site& site, std::vector<Hover> hovers, int threads = 1) {
  AssignViews(site, Camera(), kFarthest_m, hovers, threads);
  return hovers;
}

FacadeReport South(const Site& site, const std::vector<Hover>& hovers) {
  return EvaluateFacades(site, Camera(), kFarthest_m, hovers, 1).front();
}

TEST(EvaluateFacades, OneFrontalViewOfAllIsPerfect) {
  const Site site = LoneHouse();
  const FacadeReport report = South(site, Assigned(site, {Looking({10, -20, 4.5}, 0)}));
  EXPECT_NEAR(report.meant.q_s, 1, 1e-9);
  EXPECT_NEAR(report.meant.q_u, 1, 1e-9);
  EXPECT_NEAR(report.meant.q_c, 1, 1e-9);
  EXPECT_NEAR(report.meant.q_d, 0.5 * ((80.0 - 20) / (80 - 10) + 1), 1e-6);
  EXPECT_EQ(report.views, 1);
  EXPECT_NEAR(report.covered, 1, 1e-12);
}

TEST(EvaluateFacades, OppositeViewsAreWorseThanAlikeOnes) {
  const Site site = LoneHouse();
  const FacadeReport opposite =
      South(site, {Looking({-4, -20, 4.5}, 35), Looking({24, -20, 4.5}, -35)});
  // Both are as frontal; their mean direction is not.
  const double cosine = std::cos(35 * std::numbers::pi / 180);
  EXPECT_NEAR(opposite.all.q_s, 0.5 * (cosine + cosine), 1e-9);
  const FacadeReport alike =
      South(site, {Looking({-4, -20, 4.5}, 35), Looking({-6, -20, 4.5}, 35)});
  EXPECT_NEAR(alike.all.q_s, 0.5 * (cosine + 1), 1e-9);
}

TEST(EvaluateFacades, OnlyPhotosWithATargetAreMeant) {
  const Site site = LoneHouse();
  std::vector<Hover> hovers{Looking({10, -20, 4.5}, 0), Looking({10, -20, 20}, 0, -35)};
  EXPECT_EQ(South(site, hovers).views, 0);
  EXPECT_EQ(South(site, hovers).meant.sum(), 0);
  hovers[1].shots[0].targets.push_back({0, {0, 10}, {0, 9}});
  const FacadeReport report = South(site, hovers);
  EXPECT_EQ(report.views, 1);
  EXPECT_NEAR(report.covered, 0.5, 1e-9);
  EXPECT_NEAR(report.covered_all, 1, 1e-9);
}

TEST(EvaluateFacades, WithoutPhotosEveryTermIsNothing) {
  const Site site = LoneHouse();
  for (const FacadeReport& report : EvaluateFacades(site, Camera(), kFarthest_m, {}, 1)) {
    EXPECT_EQ(report.meant.sum(), 0);
    EXPECT_EQ(report.all.sum(), 0);
    EXPECT_EQ(report.covered, 0);
  }
  EXPECT_TRUE(EvaluateFacades(Site(), Camera(), kFarthest_m, {}, 1).empty());
}

TEST(MeantCells, AreThoseInATarget) {
  const Site site = LoneHouse();
  std::vector<Hover> hovers{Looking({10, -20, 4.5}, 0)};
  auto& targets = hovers[0].shots[0].targets;
  targets = {{0, {0, 3}, {0, 2}}, {0, {18, 20}, {0, 9}}, {1, {0, 10}, {0, 9}}};
  const FacadeSight sight(site, Camera(), kFarthest_m, hovers);
  const auto views = sight.ViewsOf(0);
  EXPECT_EQ(MeantCells(sight, 0, views.at(0)).size(), 3U * 2 + 2U * 9);
  targets = {{0, {}, {}}};  // as other planners may write it
  EXPECT_EQ(MeantCells(sight, 0, views.at(0)).size(), 180U);
  targets = {{1, {}, {}}};
  EXPECT_TRUE(MeantCells(sight, 0, views.at(0)).empty());
}

TEST(AssignViews, TakesTheBestViewAndNoMoreThanItTakes) {
  const Site site = LoneHouse();
  const auto hovers = Assigned(site, {Looking({10, -20, 24}, 0, -45), Looking({10, -20, 4.5}, 0),
                                      Looking({-10, -20, 4.5}, 45), Looking({10, -70, 4.5}, 0)});
  ASSERT_EQ(hovers[1].shots[0].targets.size(), 1U);
  EXPECT_EQ(hovers[1].shots[0].targets[0].facade, 0);
  EXPECT_NEAR(hovers[1].shots[0].targets[0].along_m.length_m(), 20, 1e-9);
  EXPECT_NEAR(hovers[1].shots[0].targets[0].z_m.length_m(), 9, 1e-9);
  EXPECT_TRUE(hovers[0].shots[0].targets.empty());
  EXPECT_TRUE(hovers[3].shots[0].targets.empty());
  // It also sees the west wall, which no other photo does.
  for (const Target& target : hovers[2].shots[0].targets) {
    EXPECT_NEAR(site.facades[target.facade].normal().x(), -1, 1e-9);
  }
}

TEST(AssignViews, WeighsPhotosByWhatTheyNewlyCover) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 40, 10)},
                             {.safe_altitude_m = 25, .heights_m = {9}});
  // They show 0 to 24 m, 4 to 26 m and 22 to 40 m of the south wall: the second is worth more than
  // the third only as long as the first is not chosen.
  const auto hovers = Assigned(
      site, {Looking({12, -17, 4.5}, 0), Looking({15, -15.6, 4.5}, 0), Looking({34, -17, 4.5}, 0)});
  EXPECT_EQ(hovers[0].shots[0].targets.size(), 1U);
  EXPECT_EQ(hovers[1].shots[0].targets.size(), 0U);
  ASSERT_EQ(hovers[2].shots[0].targets.size(), 1U);
  EXPECT_NEAR(hovers[2].shots[0].targets[0].along_m.from_m, 24, 1);
  EXPECT_NEAR(hovers[2].shots[0].targets[0].along_m.to_m, 40, 1e-9);
}

TEST(AssignViews, CoversAllThatAnyPhotoSees) {
  MadeSiteOptions options{.safe_altitude_m = 28, .margin_m = 28};
  const std::vector<Ring> town = RandomTown(9, 9);
  for (size_t i = 0; i < town.size(); ++i)
    options.heights_m.push_back(8.0 + static_cast<double>(i));
  const Site site = MadeSite(town, options);
  const auto hovers =
      Assigned(site, GridHovers(site, Camera(), {.forward_overlap = 0.6, .side_overlap = 0.6}));
  for (const FacadeReport& report : EvaluateFacades(site, Camera(), kFarthest_m, hovers, 2)) {
    EXPECT_NEAR(report.covered, report.covered_all, 1e-12);
    EXPECT_GT(report.covered, 0);
    // Counted for what they newly cover, photos hardly overlap.
    EXPECT_GT(report.meant.q_u, 0.8);
    EXPECT_GE(report.meant.q_d, report.all.q_d - 0.05);
  }
}

TEST(AssignViews, LeavesTargetsAloneAndFillsTheRest) {
  const Site site = LoneHouse();
  std::vector<Hover> hovers{Looking({10, -20, 4.5}, 0), Looking({10, -20, 20}, 0, -35)};
  hovers[0].shots[0].targets.push_back({0, {0, 12}, {0, 9}});
  const auto assigned = Assigned(site, hovers);
  ASSERT_EQ(assigned[0].shots[0].targets.size(), 1U);
  EXPECT_EQ(assigned[0].shots[0].targets[0].along_m, (Interval{0, 12}));
  ASSERT_EQ(assigned[1].shots[0].targets.size(), 1U);
  EXPECT_NEAR(assigned[1].shots[0].targets[0].along_m.from_m, 12, 1e-9);
  EXPECT_NEAR(South(site, assigned).covered, 1, 1e-12);
}

TEST(AssignViews, IsTheSameAtAnyNumberOfThreadsAndWhenRepeated) {
  const Site site = LoneHouse();
  const auto grid = GridHovers(site, Camera(), {.forward_overlap = 0.6, .side_overlap = 0.6});
  const auto one = Assigned(site, grid, 1);
  const auto two = Assigned(site, Assigned(site, grid, 2), 2);
  ASSERT_EQ(one.size(), two.size());
  size_t targets = 0;
  for (size_t i = 0; i < one.size(); ++i) {
    for (size_t k = 0; k < one[i].shots.size(); ++k) {
      ASSERT_EQ(one[i].shots[k].targets.size(), two[i].shots[k].targets.size());
      targets += one[i].shots[k].targets.size();
    }
  }
  EXPECT_GE(targets, site.facades.size());
}

}  // namespace
}  // namespace stucco::plan
