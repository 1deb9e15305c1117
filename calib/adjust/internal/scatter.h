// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// How robust residuals scatter: the variance of independent ones that would leave poses as
// uncertain as these do, with Cauchy loss at `scale` standard deviations. Neighbours in a picture
// err alike, by what the lens model lacks and by textures; and where only chosen tracks were
// adjusted all residuals of a photo do. They count as what their sums over cells show, of the size
// that shows most (Liang and Zeger, "Longitudinal data analysis using generalized linear models",
// 1986).
class RobustVariance {
 public:
  RobustVariance(const Scene& scene, double scale);

  void Add(const SceneElement& element, const Eigen::Vector2d& residual);
  int num_residuals() const { return 2 * count_; }
  // With the degrees of freedom that are left.
  double Get(double num_unknowns) const;
  // The share of its size that such a residual counts with.
  double Weight(const Eigen::Vector2d& residual) const;
  // Mean of how much a residual's count changes with its size, which is the weight's square.
  double MeanSlope() const { return slope_ / count_; }
  // Times as much as where cells err each by itself.
  double OfNeighbouringCells() const;
  size_t CellOf(const SceneElement& element) const;

 private:
  static constexpr int kCells = 8;  // of a picture in each direction

  // Of sums over so many cells in each direction.
  double Influence(int cells) const;
  double LargestInfluence() const;

  const Scene& scene_;
  double scale_;
  std::vector<Eigen::Vector2d> sums_;  // by photo and cell
  double slope_ = 0;
  int count_ = 0;
};

// Of all observations; `num_points` gets the number of points that they determine.
RobustVariance ScatterOf(const Scene& scene, int& num_points);

}  // namespace stucco
