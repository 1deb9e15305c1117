// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/descriptors.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

TEST(UnitRows, HaveUnitLength) {
  Random random(1);
  std::vector<float> rows(5 * kDescriptorSize);
  for (float& value : rows) value = static_cast<float>(random.Uniform(-3, 9));
  const std::vector<int16_t> unit = UnitRows(rows);
  ASSERT_EQ(unit.size(), rows.size());
  for (int r = 0; r < 5; ++r) {
    double squares = 0;
    double product = 0;
    double length = 0;
    for (int d = 0; d < kDescriptorSize; ++d) {
      const double value = unit[r * kDescriptorSize + d] / kDescriptorUnit;
      const double original = rows[r * kDescriptorSize + d];
      squares += value * value;
      product += value * original;
      length += original * original;
    }
    EXPECT_NEAR(squares, 1, 1e-3);
    EXPECT_NEAR(product / std::sqrt(length), 1, 1e-3);  // same direction
  }
}

TEST(UnitRows, LeaveZeroAsItIs) {
  EXPECT_EQ(UnitRows(std::vector<float>(kDescriptorSize, 0)),
            std::vector<int16_t>(kDescriptorSize, 0));
  EXPECT_TRUE(UnitRows({}).empty());
}

TEST(UnitDescriptors, FollowTheOrderOfKeypoints) {
  Features features;
  features.keypoints.resize(2);
  features.descriptors.resize(2);
  features.descriptors[0][3] = 200;
  features.descriptors[1][7] = 30;
  const std::vector<int16_t> rows = UnitDescriptors(features);
  ASSERT_EQ(rows.size(), 2u * kDescriptorSize);
  EXPECT_EQ(rows[3], kDescriptorUnit);
  EXPECT_EQ(rows[kDescriptorSize + 7], kDescriptorUnit);
}

TEST(DotProducts, EqualTheSumsForEveryCount) {
  Random random(2);
  for (const int count : {0, 1, 3, 4, 5, 11}) {
    std::vector<int16_t> row(kDescriptorSize);
    std::vector<int16_t> rows(static_cast<size_t>(count) * kDescriptorSize);
    for (int16_t& v : row) v = static_cast<int16_t>(random.Uniform(-2000, 2000));
    for (int16_t& v : rows) v = static_cast<int16_t>(random.Uniform(-2000, 2000));
    std::vector<int32_t> products(count + 1, 77);
    DotProducts(row.data(), rows.data(), count, products.data());
    for (int i = 0; i < count; ++i) {
      int64_t expected = 0;
      for (int d = 0; d < kDescriptorSize; ++d) {
        expected += int64_t{row[d]} * rows[i * kDescriptorSize + d];
      }
      EXPECT_EQ(products[i], expected);
    }
    EXPECT_EQ(products[count], 77);
  }
}

TEST(DotProducts, HoldTheLargestProduct) {
  std::vector<int16_t> row(kDescriptorSize, 0);
  row[5] = static_cast<int16_t>(kDescriptorUnit);
  int32_t product = 0;
  DotProducts(row.data(), row.data(), 1, &product);
  EXPECT_EQ(product, static_cast<int32_t>(kDescriptorUnit * kDescriptorUnit));
}

}  // namespace
}  // namespace stucco::test
