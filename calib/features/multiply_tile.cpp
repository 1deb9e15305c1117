// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/internal/multiply_tile.h"

#include <cstddef>
#include <cstring>

#include "calib/features/descriptors.h"
#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace stucco {
namespace {

constexpr int kPairs = kDescriptorSize / 2;

void MultiplyTileAnywhere(const RowPointers& rows, const int16_t* tile, int32_t* products,
                          int stride) {
  for (int r = 0; r < kRowsAtOnce; ++r) {
    int32_t sums[kTileRows] = {};
    for (int pair = 0; pair < kPairs; ++pair) {
      const int32_t first = rows[r][2 * pair];
      const int32_t second = rows[r][2 * pair + 1];
      const int16_t* values = tile + static_cast<ptrdiff_t>(pair) * 2 * kTileRows;
      for (int i = 0; i < kTileRows; ++i) {
        sums[i] += first * values[2 * i] + second * values[2 * i + 1];
      }
    }
    std::memcpy(products + static_cast<ptrdiff_t>(r) * stride, sums, sizeof(sums));
  }
}

#if defined(__x86_64__)

int32_t PairAt(const int16_t* row, int pair) {
  int32_t both = 0;
  std::memcpy(&both, row + static_cast<ptrdiff_t>(2) * pair, sizeof(both));
  return both;
}

__attribute__((target("avx2"))) void MultiplyTileAvx2(const RowPointers& rows, const int16_t* tile,
                                                      int32_t* products, int stride) {
  constexpr int kAtOnce = 4;  // as many sums as the registers hold
  for (int r = 0; r < kRowsAtOnce; r += kAtOnce) {
    __m256i left[kAtOnce] = {};
    __m256i right[kAtOnce] = {};
    for (int pair = 0; pair < kPairs; ++pair) {
      const auto* values =
          reinterpret_cast<const __m256i*>(tile) + static_cast<ptrdiff_t>(2) * pair;
      const __m256i a = _mm256_loadu_si256(values);
      const __m256i b = _mm256_loadu_si256(values + 1);
      for (int k = 0; k < kAtOnce; ++k) {
        const __m256i own = _mm256_set1_epi32(PairAt(rows[r + k], pair));
        left[k] = _mm256_add_epi32(left[k], _mm256_madd_epi16(own, a));
        right[k] = _mm256_add_epi32(right[k], _mm256_madd_epi16(own, b));
      }
    }
    for (int k = 0; k < kAtOnce; ++k) {
      auto* out = reinterpret_cast<__m256i*>(products + static_cast<ptrdiff_t>(r + k) * stride);
      _mm256_storeu_si256(out, left[k]);
      _mm256_storeu_si256(out + 1, right[k]);
    }
  }
}

__attribute__((target("avx512bw,avx512vnni"))) void MultiplyTileVnni(const RowPointers& rows,
                                                                     const int16_t* tile,
                                                                     int32_t* products,
                                                                     int stride) {
  __m512i sums[kRowsAtOnce] = {};
  for (int pair = 0; pair < kPairs; ++pair) {
    const __m512i values = _mm512_loadu_si512(tile + static_cast<ptrdiff_t>(pair) * 2 * kTileRows);
    for (int r = 0; r < kRowsAtOnce; ++r) {
      sums[r] = _mm512_dpwssd_epi32(sums[r], _mm512_set1_epi32(PairAt(rows[r], pair)), values);
    }
  }
  for (int r = 0; r < kRowsAtOnce; ++r) {
    _mm512_storeu_si512(products + static_cast<ptrdiff_t>(r) * stride, sums[r]);
  }
}

#endif

}  // namespace

std::vector<MultiplyTile> MultiplyTiles() {
  std::vector<MultiplyTile> tiles;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx512bw") && __builtin_cpu_supports("avx512vnni")) {
    tiles.push_back(MultiplyTileVnni);
  }
  if (__builtin_cpu_supports("avx2")) tiles.push_back(MultiplyTileAvx2);
#endif
  tiles.push_back(MultiplyTileAnywhere);
  return tiles;
}

}  // namespace stucco
