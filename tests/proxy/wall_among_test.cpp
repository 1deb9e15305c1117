// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/wall_among.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stucco {
namespace {

constexpr double kDetail_m = 0.3;
constexpr double kLength_m = 10;

// `count` points evenly over a band of 6 cm and over the whole wall.
void Add(double distance, int count, std::vector<WallHit>& hits) {
  for (int k = 0; k < count; ++k) {
    hits.push_back({.distance = distance - 0.03 + 0.06 * k / count,
                    .cell = {k % 20, k / 20 % 10},
                    .along = 0});
  }
  std::ranges::sort(hits, {}, &WallHit::distance);
}

// Panes of windows at the map's line, and 19 cm before them somewhat less of their wall.
std::vector<WallHit> PanesAndWall() {
  std::vector<WallHit> hits;
  Add(-0.03, 500, hits);
  Add(0.16, 400, hits);
  return hits;
}

TEST(WallAmong, IsWhereMostPointsLie) {
  EXPECT_NEAR(*WallAmong(PanesAndWall(), kDetail_m, {}, kLength_m), -0.03, 0.02);
}

TEST(WallAmong, IsWhereTheOtherWallsOfAMapPutIt) {
  EXPECT_NEAR(*WallAmong(PanesAndWall(), kDetail_m, {.distance = 0.16, .sigma = 0.15}, kLength_m),
              0.16, 0.02);
}

TEST(WallAmong, ManyPointsOutvoteTheOtherWalls) {
  std::vector<WallHit> hits;
  Add(0, 100, hits);
  Add(0.8, 2000, hits);
  EXPECT_NEAR(*WallAmong(hits, kDetail_m, {.distance = 0, .sigma = 0.15}, kLength_m), 0.8, 0.02);
}

// What a map has its line at covers `columns` of the 20 that lie `depth` behind it. Where the wall
// is.
double WallWithFront(int columns, double depth) {
  const auto covering = [](double distance, int of_20, int points, std::vector<WallHit>& hits) {
    for (int k = 0; k < points; ++k)
      hits.push_back({.distance = distance, .cell = {k % of_20, k / of_20 % 10}, .along = 0});
  };
  std::vector<WallHit> hits;
  covering(-depth, 20, 1500, hits);
  covering(0, columns, 800, hits);
  const ExpectedWall at_the_line{.distance = 0, .sigma = 0.15};
  return *WallAmong(hits, kDetail_m, at_the_line, kLength_m);
}

// Fronts of balconies stand where the map, which traces them, has its line: dense, and on a tenth
// to a quarter of the wall. What covers several times as much behind them is the wall; fronts that
// cover a third of it are those of loggias.
TEST(WallAmong, IsBehindBalconies) {
  EXPECT_NEAR(WallWithFront(2, 1.35), -1.35, 0.02);
  EXPECT_NEAR(WallWithFront(6, 1.35), -1.35, 0.02);
  EXPECT_NEAR(WallWithFront(7, 1.35), 0, 0.02);
}

TEST(WallAmong, IsBeforeWhatOnlyPanesLieBehind) {
  EXPECT_NEAR(WallWithFront(6, 0.45), 0, 0.02);
  EXPECT_NEAR(WallWithFront(4, 0.45), -0.45, 0.02);
}

// Stereo runs from a wall into its windows, ten centimetres behind: a strip that holds all of a
// wall holds half of what lies between.
TEST(WallAmong, IsWhereAWallPeaksBesideItsWindows) {
  std::vector<WallHit> hits;
  hits.reserve(600);
  for (int k = 0; k < 600; ++k) hits.push_back({-0.10 + 0.10 * k / 600, {k % 20, k / 20 % 10}});
  Add(-0.10, 500, hits);
  for (const double at : {-0.02, -0.01, 0.0, 0.0, 0.01, 0.02}) {
    for (int k = 0; k < 200; ++k) hits.push_back({at + 0.01 * k / 200, {k % 20, k / 20 % 10}});
  }
  std::ranges::sort(hits, {}, &WallHit::distance);
  EXPECT_NEAR(*WallAmong(hits, kDetail_m, {}, kLength_m), 0.005, 0.01);
}

TEST(WallAmong, IsBeforeItsWindowsWhereTheseAreMore) {
  std::vector<WallHit> hits;
  Add(-0.13, 1000, hits);
  Add(0, 400, hits);
  EXPECT_NEAR(*WallAmong(hits, kDetail_m, {}, kLength_m), 0, 0.015);
  std::vector<WallHit> few;  // a sill or two before a plain wall
  Add(-0.13, 1000, few);
  Add(0, 100, few);
  EXPECT_NEAR(*WallAmong(few, kDetail_m, {}, kLength_m), -0.13, 0.015);
}

TEST(WallAmong, NeedsEnoughOfAWall) {
  std::vector<WallHit> hits;
  Add(0, 5, hits);
  EXPECT_EQ(WallAmong(hits, kDetail_m, {}, kLength_m), std::nullopt);
}

}  // namespace
}  // namespace stucco
