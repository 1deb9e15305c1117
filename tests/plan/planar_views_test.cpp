// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/planar_views.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>

#include "plan/camera/photo_sights.h"
#include "plan/evaluate/evaluate_facades.h"
#include "plan/planar/move_hovers.h"
#include "plan/planar/reconstructability.h"
#include "plan/planar/thin_out.h"
#include "plan/space/obstacles.h"
#include "survey/error.h"
#include "survey/geometry2d.h"
#include "tests/site/made_site.h"
#include "tests/survey/stage_support.h"

namespace stucco::plan {
namespace {

constexpr double kFarthestView = 120;

Site TownOfThree() {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 12), Rectangle(38, 0, 52, 25),
                                    Rectangle(0, 30, 25, 45)},
                  {.safe_altitude_m = 26,
                   .margin_m = 26,
                   .heights_m = {8, 16, 11},
                   .no_fly = {{{Rectangle(60, 30, 70, 40)}}}});
}

PlanarOptions Options() {
  return {.grid = {.forward_overlap = 0.75, .side_overlap = 0.75}, .d_max_m = kFarthestView};
}

SurfaceView ViewOf(const Site& site) {
  return {site, FindCamera("mavic-3e").Field(),
          SampleSurface(site, {.spacing_m = 5, .ground_reach_m = 2 * site.d_min_m}), kFarthestView};
}

// The figures of the samples with these hovers.
std::vector<SampleState> StatesWith(const SurfaceView& view, const std::vector<Hover>& hovers) {
  ViewGraph graph(view, kFarthestView, 1);
  graph.AddAll(hovers);
  return {graph.states().begin(), graph.states().end()};
}

TEST(RemoveRedundant, LeavesWhatIsRequiredAndNothingThatCouldGo) {
  const Site site = TownOfThree();
  const SurfaceView view = ViewOf(site);
  const std::vector<Hover> grid = GridHovers(site, FindCamera("mavic-3e"), Options().grid);
  const double tau = 10 * GoodPair(26, kFarthestView);
  ViewGraph graph(view, kFarthestView, 1);
  graph.AddAll(grid);
  const auto requirements = RequirementsOf(graph, view.samples, tau);
  const auto count = static_cast<uint32_t>(grid.size());
  const size_t gone = RemoveRedundant(graph, requirements, count, SilentProgress());
  EXPECT_GT(gone, grid.size() / 2);

  std::vector<Hover> left;
  for (uint32_t i = 0; i < count; ++i) {
    if (!graph.removed(i)) left.push_back(grid[i]);
  }
  ASSERT_EQ(left.size() + gone, grid.size());
  const auto states = StatesWith(view, left);
  for (size_t s = 0; s < states.size(); ++s) {
    SampleState state = states[s];
    state.reconstructability += 1e-6;
    EXPECT_TRUE(requirements[s].MetBy(state)) << s;
  }
  for (size_t i = 0; i < left.size(); i += 5) {
    std::vector<Hover> fewer = left;
    fewer.erase(fewer.begin() + static_cast<int64_t>(i));
    const auto worse = StatesWith(view, fewer);
    bool missed = false;
    for (size_t s = 0; s < worse.size(); ++s) {
      SampleState state = worse[s];
      state.reconstructability -= 1e-6;
      missed |= !requirements[s].MetBy(state);
    }
    EXPECT_TRUE(missed) << i;
  }
}

TEST(Requirements, AreWhatTheFullSetGives) {
  const Site site = TownOfThree();
  const SurfaceView view = ViewOf(site);
  ViewGraph graph(view, kFarthestView, 1);
  graph.AddAll(GridHovers(site, FindCamera("mavic-3e"), Options().grid));
  const double tau = 100;
  const auto requirements = RequirementsOf(graph, view.samples, tau);
  int below = 0;
  for (uint32_t s = 0; s < view.samples.size(); ++s) {
    const SampleState& state = graph.state(s);
    below += state.reconstructability < tau;
    EXPECT_EQ(requirements[s].reconstructability, std::min(tau, state.reconstructability));
    EXPECT_EQ(requirements[s].hovers, std::min(3, state.hovers));
    const bool wall = view.samples[s].kind == SurfaceKind::kWall;
    EXPECT_EQ(requirements[s].nadirs, !wall && state.nadirs > 0 ? 1 : 0);
  }
  EXPECT_GT(below, 0);
  EXPECT_LT(below, static_cast<int>(view.samples.size()));
}

TEST(PlanarViews, KeepCoverageWithFarFewerHovers) {
  const Site site = TownOfThree();
  const SurfaceView view = ViewOf(site);
  const std::vector<Hover> grid = GridHovers(site, FindCamera("mavic-3e"), Options().grid);
  const std::vector<Hover> views =
      PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress());
  EXPECT_LT(views.size(), grid.size() / 2);
  EXPECT_GT(views.size(), 4U);
  const auto before = StatesWith(view, grid);
  const auto after = StatesWith(view, views);
  const double tau = 6 * GoodPair(26, kFarthestView);  // the default
  // The planner's samples are others than these, so that single points may fall a little short.
  int short_of = 0, seen = 0;
  for (size_t s = 0; s < before.size(); ++s) {
    if (before[s].reconstructability < 2 * tau) continue;
    ++seen;
    short_of += after[s].reconstructability < 0.8 * tau;
  }
  EXPECT_GT(seen, 300);
  EXPECT_LT(short_of, seen / 50);
}

TEST(PlanarViews, ShowRoofsJustBelowTheCeilingInManyGoodPairs) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 15), Rectangle(60, 0, 80, 15)},
                             {.margin_m = 30, .heights_m = {50, 12}});
  const CameraPreset camera = FindCamera("mavic-3e");
  const SurfaceView view(site, camera.Field(), SampleSurface(site, {.spacing_m = 3}),
                         kFarthestView);
  const GridOptions grid{.forward_overlap = 0.8, .side_overlap = 0.8};
  const double asked = 15 * GoodPair(10, kFarthestView);
  // The planner's samples are others than these.
  const auto short_of = [&](const std::vector<Hover>& hovers) {
    const auto states = StatesWith(view, hovers);
    int count = 0;
    for (size_t s = 0; s < states.size(); ++s) {
      count += view.samples[s].footprint == 0 && states[s].reconstructability < 0.6 * asked;
    }
    return count;
  };
  EXPECT_GT(short_of(GridHovers(site, camera, grid)), 20);
  const std::vector<Hover> views =
      PlanarViews(site, camera, {.grid = grid, .d_max_m = kFarthestView}, {}, SilentProgress());
  EXPECT_EQ(short_of(views), 0);
  EXPECT_LT(views.size(), GridHovers(site, camera, grid).size());
}

TEST(PlanarViews, AreSafeAndInTheArea) {
  const Site site = TownOfThree();
  const Obstacles obstacles(site);
  for (const Hover& hover :
       PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress())) {
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    EXPECT_TRUE(Contains(site.area, hover.position.head<2>()));
    EXPECT_GE(hover.shots.size(), 1U);
    EXPECT_LE(hover.shots.size(), 5U);
  }
}

// Of the photos at the rim of the site those that look away from it are not taken.
TEST(PlanarViews, ShowSomethingOfTheArea) {
  const Site site = TownOfThree();
  const CameraPreset camera = FindCamera("mavic-3e");
  constexpr double kPatch_m = 2;
  const SurfaceView view(site, camera.Field(),
                         SampleSurface(site, {.spacing_m = kPatch_m, .ground_reach_m = 25}), 200);
  size_t hovers_with_all = 0, photos = 0;
  const auto planned = PlanarViews(site, camera, Options(), {}, SilentProgress());
  for (const Hover& hover : planned) {
    hovers_with_all += hover.shots.size() == 5;
    photos += hover.shots.size();
    for (const Shot& shot : hover.shots) {
      double share = 0;
      for (const Sight& sight : SightsOf(view, kPatch_m * kPatch_m, hover.position, shot)) {
        share += sight.share;
      }
      EXPECT_GT(share, 0.05);
    }
  }
  EXPECT_GT(hovers_with_all, 0U);
  EXPECT_LT(photos, 5 * planned.size());
}

TEST(PlanarViews, AreTheSameAtAnyNumberOfThreads) {
  const Site site = TownOfThree();
  const auto one = PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress());
  PlanarOptions twice = Options();
  twice.threads = 2;
  const auto two = PlanarViews(site, FindCamera("mavic-3e"), twice, {}, SilentProgress());
  ASSERT_EQ(one.size(), two.size());
  for (size_t i = 0; i < one.size(); ++i) EXPECT_EQ(one[i].position, two[i].position);
}

TEST(PlanarViews, NeedFewerWhereDippingViewsSeeTheWalls) {
  const Site site = TownOfThree();
  std::vector<Hover> dipping;
  for (const Facade& facade : site.facades) {
    const Eigen::Vector2d normal = facade.normal();
    for (const double share : {0.15, 0.4, 0.65, 0.9}) {
      const Eigen::Vector2d at = facade.a + share * (facade.b - facade.a) + 12 * normal;
      dipping.push_back({{at.x(), at.y(), 8},
                         {{.yaw_rad = std::atan2(-normal.x(), -normal.y()), .targets = {}}}});
    }
  }
  const auto without = PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress());
  const auto with = PlanarViews(site, FindCamera("mavic-3e"), Options(), dipping, SilentProgress());
  EXPECT_LT(with.size(), without.size());
}

TEST(PlanarViews, AHigherThresholdKeepsMore) {
  const Site site = TownOfThree();
  PlanarOptions options = Options();
  const auto some = PlanarViews(site, FindCamera("mavic-3e"), options, {}, SilentProgress());
  options.tau_r = 60;
  const auto more = PlanarViews(site, FindCamera("mavic-3e"), options, {}, SilentProgress());
  EXPECT_GT(more.size(), some.size());
}

TEST(PlanarViews, SeeEveryWallThatTheFullGridSees) {
  // Gaps of 2 m between houses: how far one sees into them depends on the hover.
  std::vector<Ring> row;
  row.reserve(5);
  for (int i = 0; i < 5; ++i) row.push_back(Rectangle(12 * i, 0, 12 * i + 10, 14));
  const Site site =
      MadeSite(row, {.safe_altitude_m = 28, .margin_m = 28, .heights_m = {12, 18, 9, 15, 11}});
  const CameraPreset camera = FindCamera("mavic-3e");
  const auto grid = GridHovers(site, camera, Options().grid);
  PlanarOptions options = Options();
  options.sample_spacing_m = 12;  // so coarse that thinning out misses much
  const auto views = PlanarViews(site, camera, options, {}, SilentProgress());
  const auto before = EvaluateFacades(site, camera, kFarthestView, grid, 1);
  const auto after = EvaluateFacades(site, camera, kFarthestView, views, 1);
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_GT(before[i].covered_all, 0);
    EXPECT_GE(after[i].covered_all, before[i].covered_all - 1e-12);
  }
}

// Rises by 20 m from west to east under the town.
Site Slope() {
  Site site = TownOfThree();
  MadeSiteOptions made{.safe_altitude_m = 26, .margin_m = 26, .heights_m = {8, 16, 11}};
  made.terrain = {.corner = {-100, -100}, .step_m = 10, .columns = 26, .rows = 26, .z_m = {}};
  for (int i = 0; i < 26 * 26; ++i) {
    made.terrain.z_m.push_back(static_cast<float>(std::clamp(0.4 * (i % 26 - 10) * 10, 0.0, 20.0)));
  }
  std::vector<Polygon> outlines;
  for (const Footprint& footprint : site.footprints) outlines.push_back(footprint.outline);
  return MadeSite(outlines, made);
}

TEST(PlanarViews, FollowTheTerrain) {
  const Site site = Slope();
  const SurfaceView view = ViewOf(site);
  const Obstacles obstacles(site);
  const auto views = PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress());
  double lowest = 1e9, highest = 0;
  for (const Hover& hover : views) {
    EXPECT_EQ(hover.position.z(), site.CeilingAt(hover.position.head<2>()));
    EXPECT_TRUE(obstacles.IsFree(hover.position));
    lowest = std::min(lowest, hover.position.z());
    highest = std::max(highest, hover.position.z());
  }
  EXPECT_GT(highest, lowest + 8);
  // The ground does not hide itself.
  int ground = 0, seen = 0;
  const auto states = StatesWith(view, views);
  for (size_t s = 0; s < states.size(); ++s) {
    if (view.samples[s].kind != SurfaceKind::kGround) continue;
    ++ground;
    seen += states[s].nadirs > 0;
  }
  EXPECT_GT(ground, 100);
  EXPECT_GT(seen, 0.97 * ground);
}

TEST(MoveHovers, GainsWithoutLosing) {
  const Site site = TownOfThree();
  const SurfaceView view = ViewOf(site);
  const double tau = 10 * GoodPair(26, kFarthestView);
  std::vector<Hover> grid = GridHovers(site, FindCamera("mavic-3e"), Options().grid);
  ViewGraph graph(view, kFarthestView, 1);
  graph.AddAll(grid);
  const auto requirements = RequirementsOf(graph, view.samples, tau);
  RemoveRedundant(graph, requirements, static_cast<uint32_t>(grid.size()), SilentProgress());
  const auto sum = [&] {
    double out = 0;
    for (const SampleState& state : graph.states()) {
      out += state.reconstructability / (state.reconstructability + tau);
    }
    return out;
  };
  const auto sightings = [&] {
    int out = 0;
    for (uint32_t s = 0; s < view.samples.size(); ++s) {
      if (view.samples[s].kind != SurfaceKind::kWall) out += graph.state(s).nadirs;
    }
    return out;
  };
  const auto quality = [&] {  // Q_u + Q_c
    double seen = 0, all = 0;
    for (uint32_t s = 0; s < view.samples.size(); ++s) {
      if (view.samples[s].kind == SurfaceKind::kWall) continue;
      all += 1;
      seen += graph.state(s).nadirs > 0;
    }
    return seen / sightings() + seen / all;
  };
  const double before = sum();
  const double quality_before = quality();
  const Obstacles obstacles(site);
  const MoveSetting setting{.obstacles = obstacles,
                            .requirements = requirements,
                            .step_m = 3,
                            .axis = {1, 0},
                            .tau_r = tau,
                            .threads = 2};
  const std::vector<Hover> from = grid;
  const size_t moved = MoveHovers(graph, setting, grid, SilentProgress());
  EXPECT_GT(moved, 0U);
  EXPECT_GT(sum(), before);
  EXPECT_GE(quality(), quality_before - 1e-9);
  for (size_t s = 0; s < requirements.size(); ++s) {
    SampleState state = graph.state(static_cast<uint32_t>(s));
    state.reconstructability += 1e-6;
    EXPECT_TRUE(requirements[s].MetBy(state));
  }
  size_t changed = 0;
  for (size_t i = 0; i < grid.size(); ++i) {
    const double way = (grid[i].position - from[i].position).cwiseAbs().maxCoeff();
    changed += way > 0;
    EXPECT_LE(way, 3 + 1e-9);
  }
  EXPECT_EQ(changed, moved);
}

TEST(PlanarViews, StopWhenAsked) {
  stucco::test::Listener listener;
  listener.cancelled = true;
  EXPECT_THROW(PlanarViews(TownOfThree(), FindCamera("mavic-3e"), Options(), {}, listener), Error);
}

TEST(PlanarViews, OfNothingAreNone) {
  Site site = TownOfThree();
  site.area = {};
  EXPECT_TRUE(PlanarViews(site, FindCamera("mavic-3e"), Options(), {}, SilentProgress()).empty());
}

}  // namespace
}  // namespace stucco::plan
