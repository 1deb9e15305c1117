// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numbers>
#include <utility>

#include "plan/camera/preset.h"
#include "plan/match/cover_stops.h"
#include "plan/match/expected_matches.h"
#include "plan/match/facade_cover.h"
#include "plan/match/link_photos.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kSouth = std::numbers::pi, kWest = -std::numbers::pi / 2;

// An L with its inner corner at the origin: a wall of 24 m that looks north, one that looks east.
Ring Ell() {
  return {{-12, -12}, {24, -12}, {24, 0}, {0, 0}, {0, 24}, {-12, 24}};
}

int FacadeFacing(const Site& site, const Vector2d& normal) {
  int best = 0;
  for (int i = 0; i < std::ssize(site.facades); ++i) {
    const Facade& facade = site.facades[i];
    const bool inner = facade.a.minCoeff() > -1e-6 && facade.b.minCoeff() > -1e-6;
    if (inner && facade.normal().dot(normal) > 0.9) best = i;
  }
  return best;
}

Hover Dip(const Site& site, const Vector3d& position, double yaw_rad, const Vector2d& normal) {
  const int facade = FacadeFacing(site, normal);
  return {position,
          {{.yaw_rad = yaw_rad,
            .pitch_rad = 0,
            .kind = ViewKind::kDipping,
            .targets = {{facade, {0, site.facades[facade].length_m()}, {0, 8}}}}}};
}

class Corner : public testing::Test {
 protected:
  explicit Corner(double safe_altitude_m = 30, std::vector<Polygon> no_fly = {})
      : site_(MadeSite(
            std::vector<Ring>{Ell()},
            {.safe_altitude_m = safe_altitude_m, .heights_m = {8}, .no_fly = std::move(no_fly)})),
        obstacles_(site_),
        setting_{site_, camera_, 2} {}

  std::vector<Hover> TwoDips() const {
    return {Dip(site_, {14, 11, 5}, kSouth, Vector2d::UnitY()),
            Dip(site_, {11, 14, 5}, kWest, Vector2d::UnitX())};
  }

  CameraPreset camera_ = FindCamera("mavic-3e");
  Site site_;
  Obstacles obstacles_;
  MatchSetting setting_;
  Progress& progress_ = SilentProgress();
};

int LackingClose(const MatchSetting& setting, std::vector<Hover> hovers) {
  const LinkedPhotos photos(setting, hovers);
  int lacking = 0;
  for (uint32_t photo = 0; photo < photos.size(); ++photo) lacking += photos.LacksClose(photo);
  return lacking;
}

TEST_F(Corner, OneStopServesTwoFacadesAroundIt) {
  std::vector<Hover> hovers = TwoDips();
  ASSERT_EQ(LackingClose(setting_, hovers), 4);
  LinkFacades(setting_, obstacles_, hovers, progress_);
  EXPECT_EQ(LackingClose(setting_, hovers), 0);
  EXPECT_LE(hovers.size(), 4u);  // two partners for each of two photos, from two stops more at most
  const LinkedPhotos photos(setting_, hovers);
  std::vector<uint32_t> stops[2];
  for (const uint32_t dip : {0u, 1u}) {
    const auto at = std::ranges::find_if(hovers, [&](const Hover& hover) {
      return hover.shots[0].kind == ViewKind::kDipping && (hover.position.x() > 12) == (dip == 0);
    });
    ASSERT_NE(at, hovers.end());
    for (uint32_t photo = 0; photo < photos.size(); ++photo) {
      if (photos.HoverOf(photo) != at - hovers.begin() || !IsOfFacade(photos.ShotOf(photo)))
        continue;
      for (const uint32_t other : photos.ties()[photo].close) {
        stops[dip].push_back(photos.HoverOf(other));
      }
    }
  }
  EXPECT_TRUE(std::ranges::any_of(stops[0], [&](uint32_t stop) {
    return std::ranges::find(stops[1], stop) != stops[1].end();
  }));
  for (const Hover& hover : hovers) EXPECT_TRUE(obstacles_.IsFree(hover.position));
}

TEST_F(Corner, OneLookSuffices) {
  std::vector<Hover> hovers = TwoDips();
  const LinkedPhotos photos(setting_, hovers);
  const std::vector<CoverStop> stops = CoverStops(obstacles_, photos);
  ASSERT_GT(stops.size(), 10u);
  size_t of_both = 0;
  for (const CoverStop& stop : stops) {
    EXPECT_TRUE(std::ranges::is_sorted(stop.within));
    std::vector<uint32_t> served;
    for (const CoverShot& one : CoverShots(photos, stop)) {
      EXPECT_EQ(one.shot.kind, ViewKind::kLink);
      served.insert(served.end(), one.served.begin(), one.served.end());
    }
    for (const uint32_t photo : served) {
      EXPECT_TRUE(std::ranges::binary_search(stop.within, photo));
    }
    of_both += std::ranges::count(served, 0u) > 0 && std::ranges::count(served, 1u) > 0;
  }
  EXPECT_GT(of_both, 0u);
}

TEST_F(Corner, LinksAreTheSameAtAnyNumberOfThreads) {
  std::vector<Hover> one = TwoDips(), two = one;
  LinkFacades({site_, camera_, 1}, obstacles_, one, progress_);
  LinkFacades({site_, camera_, 2}, obstacles_, two, progress_);
  ASSERT_EQ(one.size(), two.size());
  for (size_t h = 0; h < one.size(); ++h) {
    EXPECT_EQ(one[h].position, two[h].position);
    ASSERT_EQ(one[h].shots.size(), two[h].shots.size());
    for (size_t s = 0; s < one[h].shots.size(); ++s) {
      EXPECT_EQ(one[h].shots[s].yaw_rad, two[h].shots[s].yaw_rad);
    }
  }
}

TEST_F(Corner, PhotosOfOneStopDiffer) {
  const Hover hover{{0, 0, 20}, {LinkShot({1, 0, 0}), {.kind = ViewKind::kDipping, .targets = {}}}};
  EXPECT_TRUE(HasLinkLike(hover, LinkShot({1, 0.2, 0})));
  EXPECT_FALSE(HasLinkLike(hover, LinkShot({1, 0.3, 0})));
  EXPECT_FALSE(HasLinkLike(hover, LinkShot({0, 1, 0})));  // the other one is no link
}

// Nothing may fly but where the dip is, just below the ceiling.
class Shut : public Corner {
 protected:
  Shut()
      : Corner(18,
               {Polygon{{Rectangle(-60, 11.5, 90, 90)}}, Polygon{{Rectangle(-60, -90, 13.5, 11)}},
                Polygon{{Rectangle(14.5, -90, 90, 11)}}}) {}
};

TEST_F(Shut, AFacadeThatNobodySafeCanLinkIsNamed) {
  std::vector<Hover> hovers{Dip(site_, {14, 10.8, 17}, kSouth, Vector2d::UnitY())};
  hovers[0].shots[0].pitch_rad = -0.8;
  ASSERT_TRUE(obstacles_.IsFree(hovers[0].position));
  EXPECT_EQ(AddLinkPhotos(setting_, obstacles_, hovers, progress_).photos, 0);
  ASSERT_EQ(hovers.size(), 1u);
  struct Plan plan;
  PlannedView view;
  view.id = "h0001v1";
  const Facade& facade = site_.facades[hovers[0].shots[0].targets[0].facade];
  view.targets.push_back({facade.id, {0, facade.length_m()}, facade.z_m});
  plan.views.push_back(view);
  const MatchStats stats = ExpectMatches(PhotoGraph(setting_, hovers), hovers, 2, plan);
  EXPECT_THAT(MatchWarnings(stats, true), testing::Contains(testing::HasSubstr(facade.id)));
}

}  // namespace
}  // namespace stucco::plan
