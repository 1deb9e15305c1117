// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "simulate/city/town.h"

namespace stucco::simulate {

std::vector<std::string> CityStyles();

// Houses, streets and what stands about, without walls' details. The same seed gives the same town,
// others clearly different ones. Outlines never overlap; neighbours touch along whole walls. Throws
// Error (kUsage) for an unknown style.
Town LayOutTown(const std::string& style, uint64_t seed);

}  // namespace stucco::simulate
