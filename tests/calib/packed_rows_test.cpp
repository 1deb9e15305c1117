// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/packed_rows.h"

#include <gtest/gtest.h>

#include "calib/features/descriptors.h"
#include "calib/features/internal/multiply_tile.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

std::vector<int16_t> RandomRows(int count, int largest, Random& random) {
  std::vector<int16_t> rows(static_cast<size_t>(count) * kDescriptorSize);
  for (int16_t& value : rows) value = static_cast<int16_t>(random.Index(largest + 1));
  return rows;
}

int32_t ProductOf(const int16_t* a, const int16_t* b) {
  int32_t sum = 0;
  for (int d = 0; d < kDescriptorSize; ++d) sum += int32_t{a[d]} * b[d];
  return sum;
}

TEST(PackedRows, EqualTheSumsForEveryCount) {
  Random random(1);
  for (const int count : {1, 15, 16, 17, 40}) {
    for (int num_rows = 1; num_rows <= PackedRows::kRows; ++num_rows) {
      const std::vector<int16_t> first = RandomRows(num_rows, 2000, random);
      const std::vector<int16_t> second = RandomRows(count, 2000, random);
      const PackedRows packed(second.data(), count);
      ASSERT_EQ(packed.count(), count);
      ASSERT_GE(packed.stride(), count);
      std::vector<int32_t> products(static_cast<size_t>(PackedRows::kRows) * packed.stride());
      packed.Multiply(first.data(), num_rows, products.data());
      for (int r = 0; r < num_rows; ++r) {
        for (int i = 0; i < count; ++i) {
          ASSERT_EQ(products[r * packed.stride() + i],
                    ProductOf(&first[r * kDescriptorSize], &second[i * kDescriptorSize]))
              << count << " " << r << " " << i;
        }
      }
    }
  }
}

TEST(MultiplyTile, IsTheSameWithVectorsOfAnyWidth) {
  Random random(2);
  const std::vector<int16_t> first = RandomRows(PackedRows::kRows, 8192, random);
  const std::vector<int16_t> tile = RandomRows(PackedRows::kTile, 255, random);
  RowPointers rows;
  for (size_t r = 0; r < rows.size(); ++r) rows[r] = &first[r * kDescriptorSize];
  constexpr int kStride = PackedRows::kTile + 3;
  std::vector<std::vector<int32_t>> products;
  for (const MultiplyTile multiply : MultiplyTiles()) {
    products.emplace_back(PackedRows::kRows * kStride, -1);
    multiply(rows, tile.data(), products.back().data(), kStride);
    EXPECT_EQ(products.back(), products.front());
  }
  EXPECT_EQ(products.front()[PackedRows::kTile], -1);  // nothing beyond the tile
  EXPECT_NE(products.front()[0], -1);
}

TEST(PackedRows, HoldTheLargestProduct) {
  std::vector<int16_t> row(kDescriptorSize, 0);
  row[77] = static_cast<int16_t>(kDescriptorUnit);
  const PackedRows packed(row.data(), 1);
  std::vector<int32_t> products(static_cast<size_t>(PackedRows::kRows) * packed.stride());
  packed.Multiply(row.data(), 1, products.data());
  EXPECT_EQ(products[0], static_cast<int32_t>(kDescriptorUnit * kDescriptorUnit));
}

}  // namespace
}  // namespace stucco::test
