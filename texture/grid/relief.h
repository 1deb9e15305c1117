// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stucco {

// How far before or behind its plane what a facet shows lies: balconies, eaves, windows in their
// reveals. A raster over the facet's grid; lengths in world units, places along the grid's axes
// from its origin, heights outwards.
struct Relief {
  double cell = 1;  // side of a cell
  int width = 0;
  int height = 0;
  double step = 0;  // between heights that it knows
  double highest = 0;
  std::vector<float> heights;  // by row

  // Of the cell at (u, v), or of the nearest one.
  double HeightAt(double u, double v) const;

  // Whether all cells that a rectangle touches are as high as each other.
  bool IsLevel(const Eigen::Vector2d& low, const Eigen::Vector2d& high) const;

  // Whether relief crosses the straight line from a point (u, v, height) on it to a camera.
  bool Hides(const Eigen::Vector3d& point, const Eigen::Vector3d& camera) const;

 private:
  int Column(double u) const;
  int Row(double v) const;
};

}  // namespace stucco
