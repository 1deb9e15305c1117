// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>
#include <span>
#include <vector>

#include "proxy/scene/scene.h"
#include "survey/geometry2d.h"

namespace stucco {

// What is known of the ground in one cell of the ground plan.
struct GroundCell {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();  // mean of its samples
  int samples = 0;                                   // 0: not seen
  int points = 0;                                    // of the cloud, that the samples stand for
};

// Heights of the ground on cells of the ground plan, in the frame whose z is up
// (UprightFromWorld). Lengths in world units.
class GroundHeights {
 public:
  // Cells of `side` that cover the box. Requires a box that is not empty and a positive side.
  GroundHeights(const Eigen::AlignedBox2d& box, double side);

  double side() const { return side_; }
  int columns() const { return columns_; }
  int rows() const { return rows_; }
  // Row by row.
  std::span<const GroundCell> cells() const { return cells_; }
  const GroundCell& At(int x, int y) const { return cells_[IndexOf(x, y)]; }
  Eigen::Vector2d MiddleOf(int x, int y) const {
    return corner_ + side_ * Eigen::Vector2d(x + 0.5, y + 0.5);
  }
  // Column and row, which may lie beside the grid.
  Eigen::Vector2i CellOf(const Eigen::Vector2d& p) const;
  // Takes a sample that lies on the ground; none that lies beside the grid.
  void Add(const Eigen::Vector3d& position, int points);

  // Height of the plane through the middles of the cells seen around a place, the nearer the more:
  // of those within two cells, or as many more as it takes to find some. 0 where none is seen at
  // all.
  double HeightAt(const Eigen::Vector2d& p) const;

 private:
  size_t IndexOf(int x, int y) const { return static_cast<size_t>(y) * columns_ + x; }

  Eigen::Vector2d corner_;
  double side_;
  int columns_, rows_;
  std::vector<GroundCell> cells_;
};

// The ground of the scene beside the footprints: what lies on its planes and, from there, samples
// that look up and go on in what is known next to them within the level of detail, such as curved
// ground, of which no plane shows all.
GroundHeights MeasureGround(const PlanarScene& scene, std::span<const Polygon> footprints);

}  // namespace stucco
