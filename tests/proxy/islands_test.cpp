// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/islands.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

constexpr double kFar_m = 1;

// A footprint of 12 x 6 m: a house to the west, a garden, and what stands to the east of it.
class Islands : public ::testing::Test {
 protected:
  Islands() {
    cover_.raster.origin = Eigen::Vector2d::Zero();
    cover_.raster.cell = 0.25;
    cover_.raster.width = 48;
    cover_.raster.height = 24;
    cover_.to_open.assign(size_t{48} * 24, 3);
  }

  // Labels from west to east, with the garden between these places and the roof's samples up to
  // `seen`.
  std::vector<int> LabelsWith(double garden_from, double garden_to, double seen) {
    const std::vector<CutLine> lines = {{.point = {garden_from, 0}, .direction = {0, 1}},
                                        {.point = {garden_to, 0}, .direction = {0, 1}}};
    const Arrangement arrangement = Arrange({Eigen::Vector2d(0, 0), Eigen::Vector2d(12, 6)}, lines);
    std::vector<float> to_hit;
    for (int y = 0; y < cover_.raster.height; ++y) {
      for (int x = 0; x < cover_.raster.width; ++x) {
        const double east = cover_.raster.Center(x, y).x();
        to_hit.push_back(static_cast<float>(std::max(0.0, east - seen)));
      }
    }
    cover_.to_hit = {to_hit};
    std::vector<int> labels;
    for (size_t f = 0; f < arrangement.faces.size(); ++f) {
      const double x = InnerPoint(arrangement, f).x();
      labels.push_back(x > garden_from && x < garden_to ? -1 : 0);
    }
    DropIslands(arrangement, cover_, kFar_m, std::vector<bool>(labels.size(), true), labels);
    std::vector<int> from_west(3);
    for (size_t f = 0; f < labels.size(); ++f) {
      const double x = InnerPoint(arrangement, f).x();
      from_west[x < garden_from ? 0 : x < garden_to ? 1 : 2] = labels[f];
    }
    return from_west;
  }

  CoverOfRoofs cover_;
};

using Labels = std::vector<int>;

TEST_F(Islands, GoWhereTheirRoofIsNowhereNear) {
  EXPECT_EQ(LabelsWith(8, 10, 8), (Labels{0, -1, -1}));
}

TEST_F(Islands, StayWhereTheirRoofIsSeen) {
  EXPECT_EQ(LabelsWith(8, 10, 12), (Labels{0, -1, 0}));
}

TEST_F(Islands, StayWhereTheyAreLarge) {
  EXPECT_EQ(LabelsWith(6, 7, 6), (Labels{0, -1, 0}));
}

TEST_F(Islands, StayWhereNoGroundLiesOpen) {
  cover_.to_open.clear();
  EXPECT_EQ(LabelsWith(8, 10, 8), (Labels{0, -1, 0}));
}

}  // namespace
}  // namespace stucco
