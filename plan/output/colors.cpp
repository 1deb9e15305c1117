// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/colors.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace stucco::plan {

Rgb QualityColor(double share) {
  // Viridis at eighths, by Smith and van der Walt (public domain).
  static constexpr std::array<Rgb, 9> kStops = {{{68, 1, 84},
                                                 {71, 44, 122},
                                                 {59, 81, 139},
                                                 {44, 113, 142},
                                                 {33, 144, 141},
                                                 {39, 173, 129},
                                                 {92, 200, 99},
                                                 {170, 220, 50},
                                                 {253, 231, 37}}};
  const double place = (share > 0 ? std::min(share, 1.0) : 0.0) * (kStops.size() - 1);
  const size_t below = std::min(static_cast<size_t>(place), kStops.size() - 2);
  const double part = place - static_cast<double>(below);
  Rgb color = {};
  for (size_t i = 0; i < color.size(); ++i) {
    color[i] = static_cast<uint8_t>(
        std::lround((1 - part) * kStops[below][i] + part * kStops[below + 1][i]));
  }
  return color;
}

Rgb FlightColor(int flight) {
  static constexpr std::array<Rgb, 6> kColors = {
      {{0, 114, 178}, {213, 94, 0}, {0, 158, 115}, {204, 121, 167}, {86, 180, 233}, {150, 110, 0}}};
  return kColors[static_cast<size_t>(std::max(flight, 0)) % kColors.size()];
}

std::string Hex(const Rgb& color) {
  return fmt::format("#{:02x}{:02x}{:02x}", color[0], color[1], color[2]);
}

}  // namespace stucco::plan
