// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/matches.h"

#include <algorithm>
#include <cassert>

#include "calib/features/best_two.h"
#include "calib/features/descriptors.h"
#include "calib/features/packed_rows.h"

namespace stucco {
namespace {

// Columns per block: 512 descriptors are 128 KB and stay in the cache while all rows pass over
// them.
constexpr int kBlock = 512;

// Largest value of a block, so that most rows need no further look.
__attribute__((target_clones("avx2", "default"))) int32_t Largest(const int32_t* values,
                                                                  int count) {
  int32_t largest = -1;
  for (int i = 0; i < count; ++i) largest = std::max(largest, values[i]);
  return largest;
}

// BestTwo of each column of a block, as vectors, so that one row is offered to many at once.
struct Columns {
  explicit Columns(int count) : best(count, -1), second(count, -1), index(count, -1) {}

  std::vector<int32_t> best;
  std::vector<int32_t> second;
  std::vector<int32_t> index;
};

// Offers one row of products to all columns.
__attribute__((target_clones("avx2", "default"))) void OfferToColumns(const int32_t* products,
                                                                      int row, Columns& columns) {
  const int count = static_cast<int>(columns.best.size());
  int32_t* best = columns.best.data();
  int32_t* second = columns.second.data();
  int32_t* index = columns.index.data();
  for (int c = 0; c < count; ++c) {
    const int32_t product = products[c];
    const bool better = product > best[c];
    const int32_t loser = better ? best[c] : product;
    second[c] = std::max(second[c], loser);
    best[c] = better ? product : best[c];
    index[c] = better ? row : index[c];
  }
}

}  // namespace

std::vector<Match> MatchDescriptors(const std::vector<int16_t>& first,
                                    const std::vector<int16_t>& second, double ratio) {
  assert(first.size() % kDescriptorSize == 0 && second.size() % kDescriptorSize == 0);
  const int num_first = static_cast<int>(first.size() / kDescriptorSize);
  const int num_second = static_cast<int>(second.size() / kDescriptorSize);
  std::vector<BestTwo> of_first(num_first);
  std::vector<BestTwo> of_second(num_second);
  std::vector<int32_t> products;
  for (int begin = 0; begin < num_second; begin += kBlock) {
    const int width = std::min(kBlock, num_second - begin);
    const PackedRows block(second.data() + static_cast<size_t>(begin) * kDescriptorSize, width);
    products.resize(static_cast<size_t>(PackedRows::kRows) * block.stride());
    Columns columns(width);
    for (int row = 0; row < num_first; ++row) {
      const int in_products = row % PackedRows::kRows;
      if (in_products == 0) {
        block.Multiply(first.data() + static_cast<size_t>(row) * kDescriptorSize,
                       std::min(PackedRows::kRows, num_first - row), products.data());
      }
      const int32_t* of_row = products.data() + static_cast<size_t>(in_products) * block.stride();
      OfferToColumns(of_row, row, columns);
      BestTwo& mine = of_first[row];
      if (Largest(of_row, width) <= mine.second) continue;
      for (int c = 0; c < width; ++c) mine.Offer(of_row[c], begin + c);
    }
    for (int c = 0; c < width; ++c) {
      of_second[begin + c] = {columns.best[c], columns.second[c], columns.index[c]};
    }
  }
  return MutualMatches(of_first, of_second, ratio);
}

}  // namespace stucco
