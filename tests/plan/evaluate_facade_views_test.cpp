// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "plan/evaluate/facade_views.h"
#include "plan/model/frustum.h"
#include "tests/plan/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kPi = std::numbers::pi;
constexpr double kDMax = 80;

// The south wall of a house of 20 m by 10 m and 9 m height is facade 0.
Site House() {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10)},
                  {.safe_altitude_m = 25, .heights_m = {9}});
}

Hover Looking(const Eigen::Vector3d& from, double yaw_deg, double pitch_deg = 0) {
  return {from,
          {{.yaw_rad = yaw_deg * kPi / 180, .pitch_rad = pitch_deg * kPi / 180, .targets = {}}}};
}

size_t CellsSeen(const Site& site, const Hover& hover, int facade = 0) {
  const std::vector<Hover> hovers{hover};
  const FacadeSight sight(site, FindCamera("mavic-3e"), kDMax, hovers);
  const auto views = sight.ViewsOf(facade);
  return views.empty() ? 0 : views.front().cells.size();
}

TEST(FacadeGrid, HasCellsOfAboutASquareMetre) {
  const Site site = House();
  const FacadeGrid grid(site.facades[0]);
  EXPECT_EQ(grid.columns, 20);
  EXPECT_EQ(grid.rows, 9);
  EXPECT_NEAR((grid.Center(0) - Eigen::Vector3d(0.5, 0, 0.5)).norm(), 0, 1e-9);
  EXPECT_NEAR((grid.Center(21) - Eigen::Vector3d(1.5, 0, 1.5)).norm(), 0, 1e-9);
  EXPECT_NEAR(grid.Along(39).to_m, 20, 1e-9);
  EXPECT_NEAR(grid.Heights(179).to_m, 9, 1e-9);
}

TEST(FacadeGrid, OfSmallAndLargeFacadesHasAFewAndNotTooManyCells) {
  Facade facade = House().facades[0];
  facade.b = {0.4, 0};
  facade.z_m = {0, 0.5};
  EXPECT_EQ(FacadeGrid(facade).columns, 3);
  EXPECT_EQ(FacadeGrid(facade).rows, 2);
  facade.b = {300, 0};
  facade.z_m = {0, 60};
  EXPECT_LE(FacadeGrid(facade).size(), 450U);
  EXPECT_GE(FacadeGrid(facade).size(), 350U);
}

TEST(FacadeSight, AFrontalViewSeesTheWholeWall) {
  EXPECT_EQ(CellsSeen(House(), Looking({10, -20, 4.5}, 0)), 180U);
}

TEST(FacadeSight, ThePictureEndsTheView) {
  // At 10 m, half the picture is 10 * 17.3 / 12.29 / 2 = 7.0 m wide and 5.3 m high.
  const size_t seen = CellsSeen(House(), Looking({0, -10, 4.5}, 0));
  EXPECT_NEAR(static_cast<double>(seen), 7 * 9, 9);
}

TEST(FacadeSight, NothingIsSeenFromBehindFarAwaySteeplyOrLookingAway) {
  const Site site = House();
  EXPECT_EQ(CellsSeen(site, Looking({10, 30, 4.5}, 180)), 0U);
  EXPECT_EQ(CellsSeen(site, Looking({10, -81, 4.5}, 0)), 0U);
  EXPECT_GT(CellsSeen(site, Looking({10, -79, 4.5}, 0)), 0U);
  EXPECT_EQ(CellsSeen(site, Looking({10, -5, 40}, 0, -80)), 0U);  // over 75 degrees
  EXPECT_EQ(CellsSeen(site, Looking({10, -20, 4.5}, 180)), 0U);
}

TEST(FacadeSight, OtherBuildingsHideTheWall) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10), Rectangle(0, -20, 10, -12)},
                             {.safe_altitude_m = 25, .heights_m = {9, 9}});
  const size_t seen = CellsSeen(site, Looking({10, -40, 4.5}, 0));
  EXPECT_NEAR(static_cast<double>(seen), 90, 9);
  EXPECT_EQ(CellsSeen(site, Looking({10, -40, 36}, 0, -38)), 180U);  // over it
}

TEST(FacadeSight, FindsWhatAskingEveryPhotoFinds) {
  MadeSiteOptions options{.safe_altitude_m = 30};
  const std::vector<Ring> town = RandomTown(8, 9);
  for (size_t i = 0; i < town.size(); ++i)
    options.heights_m.push_back(6.0 + static_cast<double>(i));
  const Site site = MadeSite(town, options);
  const CameraPreset camera = FindCamera("mavic-3e");
  std::mt19937 random(3);
  std::uniform_real_distribution<double> unit(0, 1);
  std::vector<Hover> hovers(40);
  for (Hover& hover : hovers) {
    hover.position = {160 * unit(random) - 80, 160 * unit(random) - 80, 20 + 20 * unit(random)};
    for (int k = 0; k < 3; ++k) {
      hover.shots.push_back(
          {.yaw_rad = 2 * kPi * unit(random), .pitch_rad = -kPi / 3 * unit(random), .targets = {}});
    }
  }
  const double reach = 60;
  const FacadeSight sight(site, camera, reach, hovers);
  const SiteModel model(site);
  size_t found = 0;
  for (size_t f = 0; f < site.facades.size(); ++f) {
    const FacadeGrid& grid = sight.grid(static_cast<int>(f));
    const auto views = sight.ViewsOf(static_cast<int>(f));
    auto view = views.begin();
    for (size_t h = 0; h < hovers.size(); ++h) {
      for (size_t k = 0; k < 3; ++k) {
        std::vector<uint32_t> cells;
        const Eigen::Vector3d& p = hovers[h].position;
        for (uint32_t cell = 0; cell < grid.size(); ++cell) {
          const Eigen::Vector3d ray = p - grid.Center(cell);
          const double cosine = ray.head<2>().dot(site.facades[f].normal()) / ray.norm();
          if (cosine < std::cos(75 * kPi / 180)) continue;
          if (!FrustumOf(camera, p, hovers[h].shots[k], reach).Contains(grid.Center(cell)))
            continue;
          if (model.Sees(p, grid.Center(cell))) cells.push_back(cell);
        }
        if (cells.empty()) continue;
        ASSERT_NE(view, views.end());
        EXPECT_EQ(view->hover, static_cast<int>(h));
        EXPECT_EQ(view->shot, static_cast<int>(k));
        EXPECT_EQ(view->cells, cells);
        ++view;
        ++found;
      }
    }
    EXPECT_EQ(view, views.end());
  }
  EXPECT_GT(found, 200U);
}

TEST(FacadeSight, MeasuresAPartByItsShareFrontalityAndDistance) {
  const Site site = House();
  const std::vector<Hover> hovers{Looking({10, -20, 4.5}, 30)};
  const FacadeSight sight(site, FindCamera("mavic-3e"), kDMax, hovers);
  const auto views = sight.ViewsOf(0);
  ASSERT_EQ(views.size(), 1U);
  const std::vector<uint32_t> cells{0, 19};  // both ends of the lowest row
  const SeenPart part = sight.PartOf(0, views[0], cells);
  EXPECT_NEAR(part.share, 2.0 / 180, 1e-12);
  EXPECT_NEAR(part.frontality, std::cos(kPi / 6), 1e-12);
  EXPECT_NEAR(part.distance_m, std::hypot(20, 4), 1e-9);
  EXPECT_GT(sight.ScoreOf(0, sight.PartOf(0, views[0], views[0].cells)), sight.ScoreOf(0, part));
}

}  // namespace
}  // namespace stucco::plan
