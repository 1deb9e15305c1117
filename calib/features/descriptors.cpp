// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/features/descriptors.h"

#include <cmath>

namespace stucco {
namespace {

int32_t Dot(const int16_t* a, const int16_t* b) {
  int32_t sum = 0;
  for (int d = 0; d < kDescriptorSize; ++d) sum += int32_t{a[d]} * b[d];
  return sum;
}

// One row of any numbers, scaled to unit length. Halves are rounded away from zero, in a way that
// becomes vector code.
template <typename T>
void RoundUnitRow(const T* row, int16_t* out) {
  double squares = 0;
  for (int d = 0; d < kDescriptorSize; ++d) squares += static_cast<double>(row[d]) * row[d];
  const double scale = squares > 0 ? kDescriptorUnit / std::sqrt(squares) : 0;
  for (int d = 0; d < kDescriptorSize; ++d) {
    const double value = row[d] * scale;
    out[d] = static_cast<int16_t>(static_cast<int>(value + (value < 0 ? -0.5 : 0.5)));
  }
}

}  // namespace

std::vector<int16_t> UnitRows(const std::vector<float>& rows) {
  std::vector<int16_t> result(rows.size());
  for (size_t row = 0; row < rows.size(); row += kDescriptorSize) {
    RoundUnitRow(rows.data() + row, result.data() + row);
  }
  return result;
}

std::vector<int16_t> UnitDescriptors(const Features& features) {
  std::vector<int16_t> result(features.descriptors.size() * kDescriptorSize);
  for (size_t i = 0; i < features.descriptors.size(); ++i) {
    RoundUnitRow(features.descriptors[i].data(), result.data() + i * kDescriptorSize);
  }
  return result;
}

// Compiled for 256-bit vectors too. The compiler turns the inner sums into 16-bit multiply-adds.
__attribute__((target_clones("avx2", "default"))) void DotProducts(const int16_t* row,
                                                                   const int16_t* rows, int count,
                                                                   int32_t* products) {
  int i = 0;
  for (; i + 4 <= count; i += 4) {
    const int16_t* b = rows + static_cast<size_t>(i) * kDescriptorSize;
    int32_t s0 = 0, s1 = 0, s2 = 0, s3 = 0;
    for (int d = 0; d < kDescriptorSize; ++d) {
      const int32_t a = row[d];
      s0 += a * b[d];
      s1 += a * b[d + kDescriptorSize];
      s2 += a * b[d + 2 * kDescriptorSize];
      s3 += a * b[d + 3 * kDescriptorSize];
    }
    products[i] = s0;
    products[i + 1] = s1;
    products[i + 2] = s2;
    products[i + 3] = s3;
  }
  for (; i < count; ++i) products[i] = Dot(row, rows + static_cast<size_t>(i) * kDescriptorSize);
}

}  // namespace stucco
