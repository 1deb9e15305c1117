// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facade_views.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "tests/site/made_site.h"

namespace stucco {
namespace {

constexpr double kReach_m = 80;
constexpr FieldOfView kField{0.5 * 17.3 / 12.29, 0.5 * 13 / 12.29};

Viewpoint Looking(const Eigen::Vector3d& from, double yaw_deg, double pitch_deg = 0) {
  return {from,
          {LevelFrustum(kField, from, yaw_deg * std::numbers::pi / 180,
                        pitch_deg * std::numbers::pi / 180, kReach_m)}};
}

FacadeViews ViewsFrom(const Site& site, const std::vector<Viewpoint>& places, double reach_m) {
  std::vector<Eigen::Vector3d> positions;
  for (const Viewpoint& place : places) positions.push_back(place.position);
  return {site, positions, reach_m, [places](int place) { return places[place]; }};
}

size_t CellsSeen(const Site& site, const Viewpoint& place, int facade = 0) {
  const auto views = ViewsFrom(site, {place}, kReach_m).Of(facade);
  return views.empty() ? 0 : views.front().cells.size();
}

TEST(FacadeViews, AFrontalViewSeesTheWholeWall) {
  EXPECT_EQ(CellsSeen(LoneHouse(), Looking({10, -20, 4.5}, 0)), 180U);
}

TEST(FacadeViews, ThePictureEndsTheView) {
  // At 10 m, half the picture is 10 * 17.3 / 12.29 / 2 = 7.0 m wide and 5.3 m high.
  const size_t seen = CellsSeen(LoneHouse(), Looking({0, -10, 4.5}, 0));
  EXPECT_NEAR(static_cast<double>(seen), 7 * 9, 9);
}

TEST(FacadeViews, NothingIsSeenFromBehindFarAwaySteeplyOrLookingAway) {
  const Site site = LoneHouse();
  EXPECT_EQ(CellsSeen(site, Looking({10, 30, 4.5}, 180)), 0U);
  EXPECT_EQ(CellsSeen(site, Looking({10, -81, 4.5}, 0)), 0U);
  EXPECT_GT(CellsSeen(site, Looking({10, -79, 4.5}, 0)), 0U);
  EXPECT_EQ(CellsSeen(site, Looking({10, -5, 40}, 0, -80)), 0U);  // over 75 degrees
  EXPECT_EQ(CellsSeen(site, Looking({10, -20, 4.5}, 180)), 0U);
}

TEST(FacadeViews, OtherBuildingsHideTheWall) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10), Rectangle(0, -20, 10, -12)},
                             {.safe_altitude_m = 25, .heights_m = {9, 9}});
  const size_t seen = CellsSeen(site, Looking({10, -40, 4.5}, 0));
  EXPECT_NEAR(static_cast<double>(seen), 90, 9);
  EXPECT_EQ(CellsSeen(site, Looking({10, -40, 36}, 0, -38)), 180U);  // over it
}

TEST(FacadeViews, WhatIsSeenAndWhatIsNotAreTheWholeWall) {
  const Site site = LoneHouse();
  const FacadeViews views =
      ViewsFrom(site, {Looking({0, -10, 4.5}, 0), Looking({4, -10, 4.5}, 0)}, kReach_m);
  std::vector<int> seen(views.grid(0).size());
  for (const SeenView& view : views.Of(0)) {
    for (const uint32_t cell : view.cells) ++seen[cell];
  }
  std::vector<uint32_t> unseen;
  for (uint32_t cell = 0; cell < seen.size(); ++cell) {
    if (seen[cell] == 0) unseen.push_back(cell);
  }
  EXPECT_EQ(views.Unseen(0), unseen);
  EXPECT_GT(unseen.size(), 40U);
  EXPECT_LT(unseen.size(), seen.size() / 2 + 20);
  EXPECT_TRUE(ViewsFrom(site, {Looking({10, -20, 4.5}, 0)}, kReach_m).Unseen(0).empty());
}

TEST(FacadeViews, FindsWhatAskingEveryPhotoFinds) {
  MadeSiteOptions options{.safe_altitude_m = 30};
  const std::vector<Ring> town = RandomTown(8, 9);
  for (size_t i = 0; i < town.size(); ++i)
    options.heights_m.push_back(6.0 + static_cast<double>(i));
  const Site site = MadeSite(town, options);
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  const double reach = 60;
  std::vector<Viewpoint> places(40);
  for (Viewpoint& place : places) {
    place.position = {160 * unit(random) - 80, 160 * unit(random) - 80, 20 + 20 * unit(random)};
    for (int k = 0; k < 3; ++k) {
      place.pictures.push_back(LevelFrustum(kField, place.position,
                                            2 * std::numbers::pi * unit(random),
                                            -std::numbers::pi / 3 * unit(random), reach));
    }
  }
  const FacadeViews sight = ViewsFrom(site, places, reach);
  const SiteModel model(site);
  size_t found = 0;
  for (size_t f = 0; f < site.facades.size(); ++f) {
    const FacadeGrid& grid = sight.grid(static_cast<int>(f));
    const auto views = sight.Of(static_cast<int>(f));
    auto view = views.begin();
    for (size_t h = 0; h < places.size(); ++h) {
      for (size_t k = 0; k < 3; ++k) {
        std::vector<uint32_t> cells;
        const Eigen::Vector3d& p = places[h].position;
        for (uint32_t cell = 0; cell < grid.size(); ++cell) {
          const Eigen::Vector3d ray = p - grid.Center(cell);
          const double cosine = ray.head<2>().dot(site.facades[f].normal()) / ray.norm();
          if (cosine < std::cos(75 * std::numbers::pi / 180)) continue;
          if (!places[h].pictures[k].Contains(grid.Center(cell))) continue;
          if (model.Sees(p, grid.Center(cell))) cells.push_back(cell);
        }
        if (cells.empty()) continue;
        ASSERT_NE(view, views.end());
        EXPECT_EQ(view->place, static_cast<int>(h));
        EXPECT_EQ(view->picture, static_cast<int>(k));
        EXPECT_EQ(view->cells, cells);
        ++view;
        ++found;
      }
    }
    EXPECT_EQ(view, views.end());
  }
  EXPECT_GT(found, 200U);
}

}  // namespace
}  // namespace stucco
