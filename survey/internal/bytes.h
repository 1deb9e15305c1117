// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <bit>
#include <cstring>
#include <string>
#include <type_traits>

namespace stucco::internal {

static_assert(std::endian::native == std::endian::little, "file formats are written as they lie");

template <typename Number>
void AppendLittleEndian(std::string& out, Number value) {
  static_assert(std::is_arithmetic_v<Number>);
  char bytes[sizeof(Number)];
  std::memcpy(bytes, &value, sizeof(Number));
  out.append(bytes, sizeof(Number));
}

// The number at `bytes`, which need not be aligned.
template <typename Number>
Number LoadLittleEndian(const char* bytes) {
  static_assert(std::is_arithmetic_v<Number>);
  Number value;
  std::memcpy(&value, bytes, sizeof(Number));
  return value;
}

}  // namespace stucco::internal
