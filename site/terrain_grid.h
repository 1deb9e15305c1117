// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stucco {

// Height of the ground, in the frame of the plan: a grid of samples, bilinear between them and
// constant beyond its border. Without samples the ground is z = 0.
struct TerrainGrid {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // position of sample (0, 0), the south-west
  double step_m = 1;
  int columns = 0;
  int rows = 0;
  std::vector<float> z_m;  // row by row from the south

  bool IsFlat() const { return z_m.empty(); }
  double HeightAt(const Eigen::Vector2d& position) const;
  // Highest sample within `radius_m`, interpolated ones at its rim included.
  double HighestAround(const Eigen::Vector2d& position, double radius_m) const;
};

}  // namespace stucco
