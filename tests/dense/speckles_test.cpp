// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/speckles.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stucco::test {
namespace {

TEST(RemoveSpeckles, KeepsLargePiecesOnly) {
  DepthMap map = EmptyDepthMap(20, 10);
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 8; ++x) map.depths[map.Index(x, y)] = 5.0f + 0.01f * x;  // 80 pixels
  }
  for (int x = 12; x < 17; ++x) map.depths[map.Index(x, 4)] = 5;  // 5 pixels
  RemoveSpeckles(6, 0.01f, map);
  EXPECT_GT(map.depths[map.Index(3, 3)], 0);
  EXPECT_EQ(map.depths[map.Index(12, 4)], 0);
  EXPECT_EQ(map.depths[map.Index(16, 4)], 0);
}

TEST(RemoveSpeckles, CutsAtDepthSteps) {
  DepthMap map = EmptyDepthMap(10, 10);
  std::fill(map.depths.begin(), map.depths.end(), 5.0f);
  // A patch in front of the wall touches it everywhere and is still a piece of its own.
  for (int y = 3; y < 6; ++y) {
    for (int x = 3; x < 6; ++x) map.depths[map.Index(x, y)] = 4;
  }
  RemoveSpeckles(10, 0.01f, map);
  EXPECT_EQ(map.depths[map.Index(4, 4)], 0);
  EXPECT_EQ(map.depths[map.Index(0, 0)], 5);
  EXPECT_EQ(map.depths[map.Index(6, 6)], 5);
}

TEST(RemoveSpeckles, LeavesExactlyLargeEnoughPieces) {
  DepthMap map = EmptyDepthMap(10, 1);
  for (int x = 0; x < 4; ++x) map.depths[x] = 2;
  RemoveSpeckles(4, 0.01f, map);
  EXPECT_EQ(map.depths[0], 2);
  RemoveSpeckles(5, 0.01f, map);
  EXPECT_EQ(map.depths[0], 0);
}

}  // namespace
}  // namespace stucco::test
