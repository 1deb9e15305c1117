// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/planes/plane.h"

namespace stucco {

// The planes' points in the ground plan, on cells of a few metres: which planes lie lowest around
// themselves, and which go on in one another. A roof falls off at its eaves, ground does not,
// however high it lies on its hill: heights over the whole scene decide nothing (compare the
// morphological ground filters, e.g. Zhang et al. 2003).
class PlanesInPlan {
 public:
  PlanesInPlan(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
               const std::vector<Plane>& planes);

  // Whether what is seen next to the plane lies below it along at most 30 % of its border.
  bool IsLowest(int plane) const;
  // Whether the other plane's points next to this one lie at its height.
  bool Continues(int plane, int other) const;
  // Of `others` the one nearest to the plane in plan. Requires at least one.
  int Nearest(int plane, std::span<const int> others) const;

 private:
  using Cell = std::pair<int, int>;
  struct Spot {
    int plane = 0;
    double low = 0;  // height of its lowest point in the cell, and where that is
    Eigen::Vector3d position = Eigen::Vector3d::Zero();
  };
  // A cell outside a plane, and how far it is from the plane's border, in cells.
  struct Neighbour {
    const std::vector<Spot>* spots = nullptr;
    int steps = 0;
  };

  double HeightOver(int plane, const Eigen::Vector3d& position) const;
  double StepAt(int steps) const;
  std::vector<Neighbour> Around(int plane) const;

  const std::vector<Plane>& planes_;
  Eigen::Vector3d up_;
  double cell_ = 0;
  double step_ = 0;
  std::map<Cell, std::vector<Spot>> spots_;
  std::vector<std::vector<Cell>> cells_;  // of each plane, ascending
};

}  // namespace stucco
