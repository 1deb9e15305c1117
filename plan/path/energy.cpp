// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/path/energy.h"

namespace stucco::plan {
namespace {

constexpr double kPercentPerMetre = 0.0107;
constexpr double kPercentPerHover = 0.293;
constexpr double kMinutesPerMetre = 0.00314;
constexpr double kMinutesPerHover = 0.0931;

}  // namespace

Effort EstimateEffort(double length_m, int hovers, double battery_scale) {
  return {(kPercentPerMetre * length_m + kPercentPerHover * hovers) / battery_scale,
          kMinutesPerMetre * length_m + kMinutesPerHover * hovers};
}

}  // namespace stucco::plan
