// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <vector>

#include "calib/features/features.h"

namespace stucco {

inline constexpr int kDescriptorSize = 128;
// Descriptors of unit length are kept as integers in units of 1 / kDescriptorUnit: products of them
// are exact, so that every processor finds the same matches, and vectorise as 16-bit multiply-adds.
inline constexpr double kDescriptorUnit = 8192;

// One row of kDescriptorSize values per keypoint.
std::vector<int16_t> UnitDescriptors(const Features& features);

// Rounds rows of floats, scaled to unit length, to the same form.
std::vector<int16_t> UnitRows(const std::vector<float>& rows);

// products[i] = row . rows[i], in units of 1 / kDescriptorUnit^2.
void DotProducts(const int16_t* row, const int16_t* rows, int count, int32_t* products);

}  // namespace stucco
