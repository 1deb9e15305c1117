// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/grid/grid.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <numeric>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::MakeWall;

const Eigen::Vector3d kUp = Eigen::Vector3d::UnitZ();

TEST(MakeGrid, OnAWallRunsRightAndDownSeenFromOutside) {
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.01, 8192);
  // The wall faces south: who looks at it looks north and has east on the right.
  EXPECT_TRUE(grid.u_axis.isApprox(Eigen::Vector3d::UnitX()));
  EXPECT_TRUE(grid.v_axis.isApprox(-kUp));
  EXPECT_EQ(grid.width, 400);
  EXPECT_EQ(grid.height, 300);
  EXPECT_TRUE(grid.origin.isApprox(Eigen::Vector3d(0, 0, 3)));
  EXPECT_TRUE(grid.Center(0, 0).isApprox(Eigen::Vector3d(0.005, 0, 2.995)));
}

TEST(MakeGrid, OnLevelFacetsIsAMap) {
  Facet roof;
  roof.normal = Eigen::Vector3d(0.02, 0.03, 1).normalized();
  roof.outer = {{0, 0, 0}, {2, 0, -0.04}, {2, 1, -0.07}, {0, 1, -0.03}};
  const TexelGrid grid = MakeGrid(roof, kUp, 0.1, 100);
  EXPECT_GT(grid.u_axis.x(), 0.99);
  EXPECT_LT(grid.v_axis.y(), -0.99);
  EXPECT_NEAR(grid.u_axis.dot(grid.v_axis), 0, 1e-12);
  EXPECT_NEAR(grid.u_axis.dot(roof.normal), 0, 1e-12);
}

TEST(MakeGrid, LimitsHugeFacetsAndKeepsOneTexelOfTinyOnes) {
  const TexelGrid huge = MakeGrid(MakeWall(200, 80), kUp, 0.005, 1000);
  EXPECT_EQ(huge.width, 1000);
  EXPECT_EQ(huge.height, 400);
  EXPECT_DOUBLE_EQ(huge.texel, 0.2);
  const TexelGrid tiny = MakeGrid(MakeWall(0.001, 0.001), kUp, 0.01, 8192);
  EXPECT_EQ(tiny.size(), 1u);
}

TEST(RasterizeFacet, CountsTexelCentresInsideThePolygonWithItsHole) {
  Facet facet = MakeWall(4, 3);
  facet.holes = {{{1, 0, 1}, {1, 0, 2}, {2, 0, 2}, {2, 0, 1}}};
  const TexelGrid grid = MakeGrid(facet, kUp, 0.1, 100);
  const auto mask = RasterizeFacet(facet, grid);
  EXPECT_EQ(std::accumulate(mask.begin(), mask.end(), 0), 1200 - 100);
  EXPECT_EQ(mask[15 * 40 + 15], 0);  // x 1.55, z 1.45: in the hole
  EXPECT_EQ(mask[15 * 40 + 25], 1);
}

TEST(RasterizeFacet, MarksSomethingOfASliver) {
  Facet sliver = MakeWall(4, 3);
  sliver.outer = {{0, 0, 0}, {4, 0, 3}, {3.9999, 0, 3}};
  const TexelGrid grid = MakeGrid(sliver, kUp, 0.1, 100);
  const auto mask = RasterizeFacet(sliver, grid);
  EXPECT_GE(std::accumulate(mask.begin(), mask.end(), 0), 1);
}

TEST(CountInside, AddsUpToTheMask) {
  Facet triangle = MakeWall(4, 3);
  triangle.outer = {{0, 0, 0}, {4, 0, 0}, {0, 0, 3}};
  const TexelGrid grid = MakeGrid(triangle, kUp, 0.03, 1000);
  const auto mask = RasterizeFacet(triangle, grid);
  const auto counts = CountInside(grid, mask, 4);
  const TexelGrid coarse = Coarsened(grid, 4);
  ASSERT_EQ(counts.size(), coarse.size());
  EXPECT_EQ(coarse.width, (grid.width + 3) / 4);
  EXPECT_EQ(std::accumulate(counts.begin(), counts.end(), 0),
            std::accumulate(mask.begin(), mask.end(), 0));
  EXPECT_TRUE(coarse.At(1, 1).isApprox(grid.At(4, 4)));
}

TEST(TexelGrid, FromInvertsAt) {
  const TexelGrid grid = MakeGrid(MakeWall(4, 3), kUp, 0.013, 8192);
  const Eigen::Vector2d place(17.25, 90.5);
  EXPECT_TRUE(grid.From(grid.At(place.x(), place.y())).isApprox(place, 1e-9));
}

}  // namespace
}  // namespace stucco
