// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/dipping_views.h"

#include <gtest/gtest.h>

#include <numbers>
#include <random>
#include <set>

#include "plan/dipping/candidates.h"
#include "plan/dipping/directions.h"
#include "plan/dipping/lift.h"
#include "plan/dipping/optimise.h"
#include "plan/dipping/select.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr double kDmax = 100;

// The site is kept beside what refers to it.
struct Scene {
  explicit Scene(Site made, int threads = 1)
      : site(std::move(made)),
        obstacles(site),
        setting(MakeSetting(site, obstacles, FindCamera("mavic-3e"), kDmax)) {
    setting.threads = threads;
  }
  Site site;
  Obstacles obstacles;
  DippingSetting setting;
};

DippingReport Plan(const Scene& scene) {
  return PlanDippingViews(scene.setting, SilentProgress());
}

TEST(DippingViews, AFreeHouseGetsAFrontalViewAtEachWall) {
  const Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)}, {.heights_m = {8}}));
  const DippingReport report = Plan(scene);
  std::set<int> seen;
  for (const Hover& hover : report.hovers) {
    EXPECT_TRUE(scene.obstacles.IsFree(hover.position));
    for (const Shot& shot : hover.shots) {
      for (const Target& target : shot.targets) {
        const Facade& facade = scene.site.facades[target.facade];
        EXPECT_GT(-shot.Direction().head<2>().dot(facade.normal()), 0.95);
        seen.insert(target.facade);
      }
    }
  }
  EXPECT_EQ(seen.size(), 4u);
  for (const Intervals& gaps : NotMeant(scene.site, report.hovers)) EXPECT_LT(Length(gaps), 0.05);
}

TEST(DippingViews, WhatAnyAllowedPointSeesIsCaptured) {
  const Scene scene(MadeSite(RandomTown(3, 24)));
  const DippingReport report = Plan(scene);
  const std::vector<Intervals> missed = NotMeant(scene.site, report.hovers);
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  ASSERT_EQ(levels.size(), 1u);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> uniform(-120, 120);
  double seen_m = 0, missed_m = 0;
  for (int i = 0; i < 3000; ++i) {
    const Vector2d p(uniform(random), uniform(random));
    if (!MayDip(levels[0], scene.setting, p)) continue;
    for (const SeenFacade& part : SeenFrom(levels[0], scene.setting, p)) {
      seen_m += Length(part.seen);
      missed_m += Length(Intersection(part.seen, missed[part.facade]));
    }
  }
  EXPECT_GT(seen_m, 10000);
  EXPECT_LT(missed_m, 1e-4 * seen_m);
}

TEST(DippingViews, AreTheSameAtAnyNumberOfThreads) {
  const Site site = MadeSite(RandomTown(5, 12));
  const DippingReport one = Plan(Scene(site, 1)), two = Plan(Scene(site, 2));
  ASSERT_EQ(one.hovers.size(), two.hovers.size());
  for (size_t i = 0; i < one.hovers.size(); ++i) {
    EXPECT_EQ(one.hovers[i].position, two.hovers[i].position);
    ASSERT_EQ(one.hovers[i].shots.size(), two.hovers[i].shots.size());
  }
}

TEST(DippingViews, CaptureNothingInNarrowCourtyards) {
  // 16 m wide: no point is 10 m from all of its walls.
  Polygon ring{{Rectangle(0, 0, 40, 40), Reversed(Rectangle(12, 12, 28, 28))}};
  const Scene scene(MadeSite({ring}));
  const std::vector<Intervals> missed = NotMeant(scene.site, Plan(scene).hovers);
  ASSERT_EQ(missed.size(), 8u);
  for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(Length(missed[i]), i < 4 ? 0 : 16, 0.05) << i;
}

// A level photo from 8 m up, 12 m from a wall of 0.7 m, ends above it.
TEST(Lift, TakesNoPhotoThatMissesItsWall) {
  const Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)}, {.min_altitude_m = 8, .heights_m = {0.7}}));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const Vector2d p(16.5, -11);
  const double turn = TurnTowards(scene.site.facades[0], p, 12);
  const std::vector<Hover> hovers =
      Lift(levels[0], scene.setting, {p, {{0, turn, false, {{6, 12}}}}});
  ASSERT_EQ(hovers.size(), 1u);
  ASSERT_EQ(hovers[0].shots.size(), 1u);
  EXPECT_EQ(hovers[0].shots[0].kind, ViewKind::kDippingFoot);
  ASSERT_EQ(hovers[0].shots[0].targets.size(), 1u);
  EXPECT_EQ(hovers[0].shots[0].targets[0].z_m, (Interval{0, 0.7}));
}

TEST(Lift, OnePhotoHoldsALowWall) {
  const Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)}, {.heights_m = {8}}));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const Dip dip = MakeDip(levels[0], scene.setting, {0, -17}, {0, 0, false, {{0, 12}}});
  ASSERT_EQ(dip.z_m.size(), 1u);
  EXPECT_NEAR(dip.z_m[0], 5, 0.5);  // the lowest allowed
  EXPECT_FALSE(dip.foot_pitch.has_value());
}

// Turned by 60 degrees, a photo from 10 m beside the wall's line shows what is 20 m away.
TEST(Lift, ATurnedPhotoShowsWhatItsSlantDistanceGives) {
  const Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)}, {.heights_m = {40}}));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const double aside = 10 * std::tan(std::numbers::pi / 3);
  const Vector2d p(aside, -15);  // looks at the middle of the wall, 6 m from its a
  const Dip straight = MakeDip(levels[0], scene.setting, {0, -15}, {0, 0, false, {{5.5, 6.5}}});
  const Dip turned = MakeDip(levels[0], scene.setting, p,
                             {0, TurnTowards(scene.site.facades[0], p, 6), false, {{5.5, 6.5}}});
  EXPECT_NEAR(turned.height_m, 2 * straight.height_m, 0.1 * straight.height_m);
  EXPECT_LT(turned.z_m.size(), straight.z_m.size());
}

TEST(DippingViews, NeighboursOnALongWallOverlap) {
  const Scene scene(MadeSite({Rectangle(-40, -5, 40, 5)}, {.heights_m = {6}}));
  std::vector<Interval> parts;
  for (const Hover& hover : Plan(scene).hovers) {
    for (const Shot& shot : hover.shots) {
      const double half = scene.setting.width_per_m / 2 * (-hover.position.y() - 5);
      if (shot.targets.front().facade != 0) continue;
      parts.push_back({hover.position.x() - half, hover.position.x() + half});  // frontal
    }
  }
  ASSERT_GE(parts.size(), 3u);
  std::ranges::sort(parts, {}, &Interval::from_m);
  for (size_t i = 1; i < parts.size(); ++i) {
    const double shared = parts[i - 1].to_m - parts[i].from_m;
    EXPECT_GE(shared, 0.2 * std::min(parts[i - 1].length_m(), parts[i].length_m())) << i;
  }
}

TEST(Lift, PhotosOfAHighWallOverlapByAFifthAndHoldTopAndFoot) {
  const Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)}, {.heights_m = {45}}));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const Dip dip = MakeDip(levels[0], scene.setting, {0, -20}, {0, 0, false, {{0, 12}}});
  ASSERT_GE(dip.z_m.size(), 3u);
  const double half = dip.height_m / 2;
  EXPECT_GT(dip.z_m.front() + half, 45);
  EXPECT_LT(dip.z_m.back() - half, 0);
  for (size_t i = 1; i < dip.z_m.size(); ++i) {
    EXPECT_LE(dip.z_m[i - 1] - dip.z_m[i], 0.8 * dip.height_m + 1e-9);
  }
}

TEST(Lift, AFootThatIsOutOfSightGetsATiltedPhotoThatShowsIt) {
  Scene scene(MadeSite({Rectangle(-6, -5, 6, 5)},
                       {.d_min_m = 10, .min_altitude_m = 12, .heights_m = {30}}));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const Vector2d p(0, -16);
  const Dip dip = MakeDip(levels[0], scene.setting, p, {0, 0, false, {{0, 12}}});
  ASSERT_TRUE(dip.foot_pitch.has_value());
  const double half_fov = std::atan(dip.height_m / 2 / 11);
  const double to_foot = -std::atan2(dip.z_m.back(), 11.0);
  EXPECT_GT(to_foot, *dip.foot_pitch - half_fov);
  EXPECT_LT(*dip.foot_pitch, 0);
}

TEST(HoveringCost, MergingSavesOneOfTwoStopsAtTheSameHeight) {
  const Dip a{{20, 12}, 10, {}}, b{{20, 5}, 10, {}};
  EXPECT_DOUBLE_EQ(HoveringCost(std::vector<Dip>{a}, 0.8), 2);
  EXPECT_NEAR(HoveringCost(std::vector<Dip>{a, b}, 0.8), 3, 1e-9);
  const std::vector<Dip> five(5, b);
  EXPECT_NEAR(HoveringCost(five, 0.8), 2, 1e-9);  // never less than the heights there are
  const Dip far{{24, 16}, 10, {}};                // farther than the overlap of 2 m
  EXPECT_DOUBLE_EQ(HoveringCost(std::vector<Dip>{a, far}, 0.8), 4);
}

TEST(OptimiseViews, LosesNothingAndRaisesQuality) {
  const Scene scene(MadeSite(RandomTown(9, 16)));
  const std::vector<Level> levels = SplitIntoLevels(scene.site);
  const std::vector<Candidate> candidates = FindCandidates(levels[0], scene.setting);
  std::vector<double> turns = InitialTurns(levels[0], scene.setting, candidates);
  std::vector<DippingPoint> points =
      SelectPoints(scene.setting, ViewsOf(scene.setting, candidates, turns));
  const auto measure = [&](const std::vector<DippingPoint>& some) {
    std::vector<std::vector<SeenPart>> parts(scene.site.facades.size());
    std::vector<Intervals> seen(scene.site.facades.size());
    for (const DippingPoint& point : some) {
      for (const WallView& view : point.views) {
        parts[view.facade].push_back(PartOf(scene.site.facades[view.facade], point.position, view));
        seen[view.facade].insert(seen[view.facade].end(), view.seen.begin(), view.seen.end());
      }
    }
    double quality = 0, length = 0;
    for (size_t i = 0; i < parts.size(); ++i) {
      const double covered = Length(Union(seen[i]));
      length += covered;
      quality +=
          QualityOfFacade(parts[i], covered / scene.site.facades[i].length_m(), 10, kDmax).sum();
    }
    return std::pair(quality, length);
  };
  const auto [quality_before, length_before] = measure(points);
  const OptimiseReport report = OptimiseViews(levels[0], scene.setting, turns, points);
  const auto [quality_after, length_after] = measure(points);
  EXPECT_GT(report.moved, 0);
  EXPECT_GT(quality_after, quality_before);
  EXPECT_GE(length_after, length_before - 1e-6);
  const OptimiseReport again = OptimiseViews(levels[0], scene.setting, turns, points);
  EXPECT_EQ(again.moved + again.turned + again.removed, 0);
}

}  // namespace
}  // namespace stucco::plan
