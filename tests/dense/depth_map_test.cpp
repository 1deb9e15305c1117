// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/depth_map.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/survey/support.h"

namespace stucco::test {
namespace {

DepthMap Made(int width, int height) {
  DepthMap map = EmptyDepthMap(width, height);
  for (size_t i = 0; i < map.depths.size(); ++i) {
    map.depths[i] = 1.0f + static_cast<float>(i) / 3;
    map.normals[i] = {static_cast<int8_t>(i % 50), static_cast<int8_t>(-20), -100};
    map.costs[i] = static_cast<uint8_t>(i % 255);
  }
  return map;
}

TEST(DepthMap, StartsEmpty) {
  const DepthMap map = EmptyDepthMap(4, 3);
  EXPECT_EQ(map.depths, std::vector<float>(12, 0.0f));
  EXPECT_EQ(map.costs, std::vector<uint8_t>(12, 255));
  EXPECT_EQ(map.Index(3, 2), 11u);
}

TEST(DepthMap, NormalsHaveUnitLength) {
  DepthMap map = EmptyDepthMap(1, 1);
  map.normals[0] = {0, 90, -90};
  EXPECT_LT((map.Normal(0) - Eigen::Vector3f(0, std::sqrt(0.5f), -std::sqrt(0.5f))).norm(), 1e-6f);
}

TEST(SerializeDepthMap, ReadsBack) {
  const DepthMap map = Made(7, 5);
  const std::string bytes = Serialize(map);
  EXPECT_EQ(bytes.substr(0, 4), "SDM1");
  EXPECT_EQ(bytes.size(), 12u + 35 * 8);
  const DepthMap back = DeserializeDepthMap(bytes);
  EXPECT_EQ(back.width, 7);
  EXPECT_EQ(back.height, 5);
  EXPECT_EQ(back.depths, map.depths);
  EXPECT_EQ(back.normals, map.normals);
  EXPECT_EQ(back.costs, map.costs);
}

TEST(SerializeDepthMap, RefusesEveryCut) {
  const std::string bytes = Serialize(Made(7, 5));
  for (size_t length = 0; length < bytes.size(); ++length) {
    ExpectBadInput([&] { DeserializeDepthMap(std::string_view(bytes).substr(0, length)); },
                   "damaged");
  }
  ExpectBadInput([&] { DeserializeDepthMap(bytes + "x"); }, "damaged");
}

TEST(SerializeDepthMap, RefusesWrongHeads) {
  std::string bytes = Serialize(Made(7, 5));
  std::string other = bytes;
  other[3] = '2';
  ExpectBadInput([&] { DeserializeDepthMap(other); }, "damaged");
  const auto with_size = [&](int32_t width, int32_t height) {
    std::string changed = bytes;
    std::memcpy(changed.data() + 4, &width, 4);
    std::memcpy(changed.data() + 8, &height, 4);
    return changed;
  };
  for (const auto& [width, height] :
       {std::pair{5, 5}, std::pair{-7, -5}, std::pair{0, 35}, std::pair{35, 0},
        std::pair{1 << 30, 1 << 30}, std::pair{7, 5 + (1 << 29)}}) {
    ExpectBadInput([&] { DeserializeDepthMap(with_size(width, height)); }, "damaged");
  }
}

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
