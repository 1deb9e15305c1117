// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matches.h"

#include <algorithm>

#include "calib/best_two.h"
#include "calib/descriptors.h"

namespace stucco {
namespace {

// Columns per block: 512 descriptors are 128 KB and stay in the cache while all rows pass over
// them.
constexpr int kBlock = 512;

// Largest value of a block, so that most rows need no further look.
__attribute__((target_clones("arch=haswell", "default"))) int32_t Largest(const int32_t* values,
                                                                          int count) {
  int32_t largest = -1;
  for (int i = 0; i < count; ++i) largest = std::max(largest, values[i]);
  return largest;
}

// Offers one row of products to all columns.
__attribute__((target_clones("arch=haswell", "default"))) void OfferToColumns(
    const int32_t* products, int row, int count, int32_t* best, int32_t* second, int32_t* index) {
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
  const int num_first = static_cast<int>(first.size() / kDescriptorSize);
  const int num_second = static_cast<int>(second.size() / kDescriptorSize);
  std::vector<BestTwo> of_first(num_first);
  std::vector<BestTwo> of_second(num_second);
  std::vector<int32_t> products(kBlock);
  for (int begin = 0; begin < num_second; begin += kBlock) {
    const int columns = std::min(kBlock, num_second - begin);
    const int16_t* block = second.data() + static_cast<size_t>(begin) * kDescriptorSize;
    std::vector<int32_t> best(columns, -1);
    std::vector<int32_t> next(columns, -1);
    std::vector<int32_t> index(columns, -1);
    for (int row = 0; row < num_first; ++row) {
      DotProducts(first.data() + static_cast<size_t>(row) * kDescriptorSize, block, columns,
                  products.data());
      OfferToColumns(products.data(), row, columns, best.data(), next.data(), index.data());
      BestTwo& mine = of_first[row];
      if (Largest(products.data(), columns) <= mine.second) continue;
      for (int c = 0; c < columns; ++c) mine.Offer(products[c], begin + c);
    }
    for (int c = 0; c < columns; ++c) of_second[begin + c] = {best[c], next[c], index[c]};
  }
  return MutualMatches(of_first, of_second, ratio);
}

}  // namespace stucco
