// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/hover.h"

#include <cmath>

namespace stucco::plan {

Eigen::Vector3d Shot::Direction() const {
  const double level = std::cos(pitch_rad);
  return {std::sin(yaw_rad) * level, std::cos(yaw_rad) * level, std::sin(pitch_rad)};
}

}  // namespace stucco::plan
