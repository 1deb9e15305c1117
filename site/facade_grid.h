// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "site/site.h"

namespace stucco {

// A facade as equal cells, of about a square metre each; at least three columns and two rows, at
// most about 400 cells. Each is seen or not seen by its centre.
struct FacadeGrid {
  explicit FacadeGrid(const Facade& facade);

  size_t size() const { return static_cast<size_t>(columns) * rows; }
  Eigen::Vector3d Center(uint32_t cell) const;
  Interval Along(uint32_t cell) const;
  Interval Heights(uint32_t cell) const;

  Eigen::Vector2d a, along;
  double length_m = 0;
  Interval z_m;
  int columns = 0;
  int rows = 0;
};

}  // namespace stucco
