// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

namespace stucco {

// A wall of the map from a to b, seen from its right side only.
struct MapWall {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
  int facade = -1;  // -1: it only blocks the view
};

}  // namespace stucco
