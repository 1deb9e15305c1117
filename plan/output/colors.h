// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>

namespace stucco::plan {

using Rgb = std::array<uint8_t, 3>;

// From bad (0) to good (1): Viridis, in which order and lightness agree, so that it reads the same
// in print and with any kind of colour vision.
Rgb QualityColor(double share);

// Colours that stay apart for the colour-blind (Okabe and Ito, "Color Universal Design", 2008), in
// turn.
Rgb FlightColor(int flight);

std::string Hex(const Rgb& color);  // #rrggbb

}  // namespace stucco::plan
