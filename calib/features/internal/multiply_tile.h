// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace stucco {

inline constexpr int kTileRows = 16;   // packed side by side (PackedRows)
inline constexpr int kRowsAtOnce = 8;  // multiplied with them

using RowPointers = std::array<const int16_t*, kRowsAtOnce>;

// Products of the rows with one tile of PackedRows: `products` has the first row's, `stride`
// further on the next one's.
using MultiplyTile = void (*)(const RowPointers& rows, const int16_t* tile, int32_t* products,
                              int stride);

// Those that this processor can run, the fastest first. All give the same.
std::vector<MultiplyTile> MultiplyTiles();

}  // namespace stucco
