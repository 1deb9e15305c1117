// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stucco::plan {

// Height of the ground, in the frame of the plan: a grid of samples, bilinear between them and
// constant beyond its border. Without samples the ground is z = 0.
struct Terrain {
  Eigen::Vector2d corner = Eigen::Vector2d::Zero();  // position of sample (0, 0), the south-west
  double step_m = 1;
  int columns = 0;
  int rows = 0;
  std::vector<float> z_m;  // row by row from the south

  bool IsFlat() const { return z_m.empty(); }
  double HeightAt(const Eigen::Vector2d& position) const;
  // Highest and lowest sample within `radius_m`, interpolated ones at its rim included.
  double HighestAround(const Eigen::Vector2d& position, double radius_m) const;
  double LowestAround(const Eigen::Vector2d& position, double radius_m) const;
  // Highest ground under the segment from p to q.
  double HighestBetween(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const;
};

}  // namespace stucco::plan
