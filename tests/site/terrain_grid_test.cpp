// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later

#include "site/terrain_grid.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace stucco {
namespace {

// Samples of height(x, y) every 2 m over 40 m x 30 m from (-10, -20).
template <class Height>
TerrainGrid Sampled(const Height& height) {
  TerrainGrid terrain{.corner = {-10, -20}, .step_m = 2, .columns = 21, .rows = 16, .z_m = {}};
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      terrain.z_m.push_back(static_cast<float>(height(-10 + 2 * column, -20 + 2 * row)));
    }
  }
  return terrain;
}

TerrainGrid Rough() {
  std::mt19937 random(3);
  return Sampled([&](double, double) { return 10 + (random() % 1000) / 100.0; });
}

TEST(TerrainGrid, WithoutSamplesIsZeroEverywhere) {
  const TerrainGrid flat;
  EXPECT_TRUE(flat.IsFlat());
  EXPECT_EQ(flat.HeightAt({1e6, -3}), 0);
  EXPECT_EQ(flat.HighestAround({5, 5}, 30), 0);
}

TEST(TerrainGrid, IsExactOnAPlane) {
  const TerrainGrid plane = Sampled([](double x, double y) { return 100 + 0.5 * x - 0.25 * y; });
  for (double x = -10; x <= 30; x += 0.7) {
    for (double y = -20; y <= 10; y += 0.7) {
      EXPECT_NEAR(plane.HeightAt({x, y}), 100 + 0.5 * x - 0.25 * y, 1e-5);
    }
  }
  const double slope = std::hypot(0.5, 0.25);
  EXPECT_NEAR(plane.HighestAround({10, -5}, 5), 100 + 5 + 1.25 + 5 * slope, 0.01);
}

TEST(TerrainGrid, StaysConstantBeyondItsBorder) {
  const TerrainGrid plane = Sampled([](double x, double) { return x; });
  EXPECT_NEAR(plane.HeightAt({500, 0}), 30, 1e-9);
  EXPECT_NEAR(plane.HeightAt({-500, 900}), -10, 1e-9);
  EXPECT_NEAR(plane.HighestAround({-500, 900}, 3), -10, 1e-9);
}

TEST(TerrainGrid, OneSampleOrOneRowIsEnough) {
  const TerrainGrid one{.corner = {0, 0}, .step_m = 5, .columns = 1, .rows = 1, .z_m = {7}};
  EXPECT_EQ(one.HeightAt({3, -8}), 7);
  const TerrainGrid row{.corner = {0, 0}, .step_m = 5, .columns = 3, .rows = 1, .z_m = {0, 10, 0}};
  EXPECT_NEAR(row.HeightAt({2.5, 40}), 5, 1e-9);
}

TEST(TerrainGrid, HighestAroundBoundsWhatIsInTheDisc) {
  const TerrainGrid rough = Rough();
  for (const double radius : {0.0, 0.5, 3.0, 12.0}) {
    for (double x = -15; x < 35; x += 3.3) {
      const Eigen::Vector2d centre(x, -3 + x / 7);
      double highest = rough.HeightAt(centre);
      double lowest = highest;
      for (double r = 0; r <= radius; r += 0.05) {
        for (double angle = 0; angle < 6.283; angle += 0.05) {
          const double z =
              rough.HeightAt(centre + r * Eigen::Vector2d(std::cos(angle), std::sin(angle)));
          highest = std::max(highest, z);
          lowest = std::min(lowest, z);
        }
      }
      // Between two rim points the surface rises by a part of what it does within a cell (10 m).
      EXPECT_NEAR(rough.HighestAround(centre, radius), highest, 0.7);
    }
  }
}

}  // namespace
}  // namespace stucco
