// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <numbers>

namespace stucco {

// How far from a surface's normal a photo may look at it: the limits of visibility of all modules.
// What textures are painted from is an option (texture.max_angle_deg).

// To count as a photo of a wall when it is planned: farther off, it is too stretched.
inline constexpr double kMaxIncidence_rad = 75 * std::numbers::pi / 180;
// To show anything of a surface that matches or can be measured: farther off, it is a line.
inline constexpr double kMaxShownIncidence_rad = 80 * std::numbers::pi / 180;

}  // namespace stucco
