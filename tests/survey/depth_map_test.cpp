// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/depth_map.h"

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

TEST(DepthMap, ExactOnesHaveNoCost) {
  const DepthMap map = ExactDepths(2, 1, {3, 0});
  EXPECT_EQ(map.depths, (std::vector<float>{3, 0}));
  EXPECT_EQ(map.costs, std::vector<uint8_t>(2, 0));
  EXPECT_EQ(Serialize(map).size(), 12u + 2 * 8);
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

}  // namespace
}  // namespace stucco::test
