// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <iostream>
#include <nlohmann/json.hpp>

namespace stucco {

using Json = nlohmann::ordered_json;

// On standard output. Paths need not be UTF-8; what is not becomes U+FFFD.
inline void PrintJson(const Json& json) {
  std::cout << json.dump(1, ' ', false, Json::error_handler_t::replace) << "\n";
}

}  // namespace stucco
