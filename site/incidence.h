// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace stucco {

// Farther than this from its normal a wall is too stretched in a photo to count as seen.
inline constexpr double kMaxIncidence_rad = 75 * std::numbers::pi / 180;

}  // namespace stucco
