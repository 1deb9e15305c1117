// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

namespace stucco {

// Descriptors (rows of kDescriptorSize values, UnitDescriptors) laid out so that sixteen of them
// are multiplied with others at once. Products are exact sums of integers, so that they are the
// same on every processor, however wide its vectors are.
class PackedRows {
 public:
  static constexpr int kTile = 16;  // packed rows that are multiplied at once ...
  static constexpr int kRows = 8;   // ... with as many of the others, at most

  PackedRows(const int16_t* rows, int count);

  int count() const { return count_; }
  // Products of one row with all packed ones, rounded up to whole tiles: the length of a row of
  // products.
  int stride() const { return static_cast<int>(tiles_.size()) / kValuesOfTile * kTile; }

  // products[r * stride() + i] is the product of rows[r] with packed row i, for r below `num_rows`
  // (at most kRows). Writes kRows * stride() values; those beyond have no meaning.
  void Multiply(const int16_t* rows, int num_rows, int32_t* products) const;

 private:
  static constexpr int kValuesOfTile = kTile * 128;

  int count_ = 0;
  std::vector<int16_t> tiles_;  // pairs of values of sixteen rows side by side, pair after pair
};

}  // namespace stucco
