// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/rasterize.h"

#include <gtest/gtest.h>

#include <numeric>

namespace stucco {
namespace {

using Ring = std::vector<Eigen::Vector2d>;

int Count(const std::vector<uint8_t>& mask) {
  return std::accumulate(mask.begin(), mask.end(), 0);
}

TEST(RasterizeRings, TakesPixelsByTheirCentres) {
  const std::vector<Ring> rings = {{{0.4, 0.4}, {2.6, 0.4}, {2.6, 1.6}, {0.4, 1.6}}};
  EXPECT_EQ(RasterizeRings(rings, 4, 3), (std::vector<uint8_t>{1, 1, 1, 0,  //
                                                               1, 1, 1, 0,  //
                                                               0, 0, 0, 0}));
}

TEST(RasterizeRings, LeavesOutHolesWhicheverWayTheyRun) {
  const Ring outer = {{0, 0}, {10, 0}, {10, 10}, {0, 10}};
  const Ring hole = {{2, 2}, {6, 2}, {6, 5}, {2, 5}};
  EXPECT_EQ(Count(RasterizeRings(std::vector<Ring>{outer, hole}, 10, 10)), 100 - 12);
  const Ring other_way(hole.rbegin(), hole.rend());
  EXPECT_EQ(Count(RasterizeRings(std::vector<Ring>{outer, other_way}, 10, 10)), 100 - 12);
}

TEST(RasterizeRings, NeighboursShareNoPixelAndMissNone) {
  const Ring left = {{0, 0}, {3.3, 0}, {7.1, 9}, {0, 9}};
  const Ring right = {{3.3, 0}, {9, 0}, {9, 9}, {7.1, 9}};
  const auto a = RasterizeRings(std::vector<Ring>{left}, 9, 9);
  const auto b = RasterizeRings(std::vector<Ring>{right}, 9, 9);
  for (size_t i = 0; i < a.size(); ++i) EXPECT_EQ(a[i] + b[i], 1);
}

TEST(RasterizeRings, WhatLiesOutsideOrHasNoAreaMarksNothing) {
  const std::vector<Ring> around = {{{-1e9, -1e9}, {1e9, -1e9}, {1e9, 1e9}, {-1e9, 1e9}}};
  EXPECT_EQ(Count(RasterizeRings(around, 5, 4)), 20);
  const std::vector<Ring> away = {{{20, 0}, {30, 0}, {30, 5}}};
  EXPECT_EQ(Count(RasterizeRings(away, 5, 4)), 0);
  const std::vector<Ring> line = {{{0, 2}, {5, 2}}, {}, {{1, 1}}};
  EXPECT_EQ(Count(RasterizeRings(line, 5, 4)), 0);
  EXPECT_TRUE(RasterizeRings({}, 0, 0).empty());
}

}  // namespace
}  // namespace stucco
