// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace stucco {

// File names and messages of other libraries need not be UTF-8; what is not becomes U+FFFD.
static inline std::string Dump(const nlohmann::ordered_json& json, int indent = -1) {
  return json.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
}

// Enough digits for people: 12.345.
static inline double Rounded(double value, double step = 0.001) {
  return std::round(value / step) * step;
}

}  // namespace stucco
