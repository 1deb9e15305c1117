// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/site.h"

namespace stucco {

double Site::CeilingAt(const Eigen::Vector2d& position) const {
  return ceiling.IsFlat() ? safe_altitude_m : ceiling.HeightAt(position);
}

}  // namespace stucco
