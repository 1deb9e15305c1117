// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/space/safe_space.h"

namespace stucco::plan {

// An end of a hover's sequence of photos: 2 * hover for the first, 2 * hover + 1 for the last. The
// drone comes in at one and leaves by the other; it may take a sequence either way.
using Port = int;

// No metre costs less.
constexpr double kLeastWeight = 0.5;

// Costs of flying from hover to hover (Xiong et al. 2025, section 6):
//   e = w l exp(alpha / l)
// l is the length of the shortest safe path, alpha the angle in radians between the photos before
// and after, w 0.5 when both hovers capture a common facade, 0.75 when they capture facades that
// share a corner, else 1; the best pair of targets counts. The exponent's l is at least one metre:
// the paper's term grows without limit where hovers nearly meet, and turning in place does not. As
// a sequence may be taken either way, the cost is symmetric between ports.
class HoverCosts {
 public:
  // Keeps references to the space and the hovers.
  HoverCosts(const SafeSpace& space, std::span<const Hover> hovers);

  int size() const { return static_cast<int>(hovers_.size()); }
  const Eigen::Vector3d& Position(int hover) const { return hovers_[hover].position; }
  double Straight(int i, int j) const { return (Position(i) - Position(j)).norm(); }
  double Length(int i, int j) const { return space_->Distance(Position(i), Position(j)); }
  double Weight(int i, int j) const;
  double Turn(Port a, Port b) const;        // alpha
  double LeastTurn(int i, int j) const;     // over all ports of both
  double LeastCost(int i, int j) const;     // no way between the two is cheaper; needs no search
  double CheapestCost(int i, int j) const;  // of the best ports, with the true length

  static double Cost(double weight, double length_m, double turn_rad);

 private:
  const SafeSpace* space_;
  std::span<const Hover> hovers_;
  std::vector<Eigen::Vector3d> directions_;         // by port
  std::vector<std::vector<int>> facades_;           // of each hover, in order
  std::vector<std::vector<int>> adjacent_facades_;  // that share a corner with those
};

}  // namespace stucco::plan
