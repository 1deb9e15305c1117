// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/site.h"

namespace stucco::plan {

double Site::CeilingAt(const Eigen::Vector2d& position) const {
  return ceiling.IsFlat() ? safe_altitude_m : ceiling.HeightAt(position);
}

double Site::CeilingBetween(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
  return ceiling.IsFlat() ? safe_altitude_m : ceiling.HighestBetween(p, q);
}

}  // namespace stucco::plan
