// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/packed_rows.h"

#include <cassert>
#include <cstddef>
#include <cstring>

#include "calib/features/descriptors.h"
#include "calib/features/internal/multiply_tile.h"

namespace stucco {

PackedRows::PackedRows(const int16_t* rows, int count) : count_(count) {
  static_assert(kTile == kTileRows && kRows == kRowsAtOnce);
  static_assert(kValuesOfTile == kTile * kDescriptorSize);
  tiles_.assign(static_cast<size_t>((count + kTile - 1) / kTile) * kValuesOfTile, 0);
  for (int i = 0; i < count; ++i) {
    int16_t* tile = tiles_.data() + static_cast<ptrdiff_t>(i / kTile) * kValuesOfTile;
    const int16_t* row = rows + static_cast<ptrdiff_t>(i) * kDescriptorSize;
    for (int pair = 0; pair < kDescriptorSize / 2; ++pair) {
      std::memcpy(tile + (static_cast<ptrdiff_t>(pair) * kTile + i % kTile) * 2, row + 2 * pair,
                  2 * sizeof(int16_t));
    }
  }
}

void PackedRows::Multiply(const int16_t* rows, int num_rows, int32_t* products) const {
  assert(num_rows > 0 && num_rows <= kRows);
  static const MultiplyTile multiply = MultiplyTiles().front();
  RowPointers pointers;
  for (int r = 0; r < kRows; ++r) {
    pointers[r] = rows + static_cast<ptrdiff_t>(r < num_rows ? r : 0) * kDescriptorSize;
  }
  for (int begin = 0; begin < count_; begin += kTile) {
    multiply(pointers, tiles_.data() + static_cast<ptrdiff_t>(begin) * kDescriptorSize,
             products + begin, stride());
  }
}

}  // namespace stucco
