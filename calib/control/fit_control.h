// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "survey/pose.h"

namespace stucco {

// A control point where photos place it and where it was surveyed.
struct PointPair {
  Eigen::Vector3d in_scene = Eigen::Vector3d::Zero();
  Eigen::Vector3d surveyed = Eigen::Vector3d::Zero();
};

struct ControlFit {
  std::optional<Similarity> surveyed_from_scene;
  std::string why_not;             // where there is none, for users
  std::vector<int> blunders;       // pairs that contradict the others
  std::vector<double> residual_m;  // per pair
};

// Robust similarity: the triple of pairs that most others agree with (RANSAC of all triples, costs
// as in MSAC, Torr and Zisserman 2000), then least squares over these (Umeyama 1991). Pairs agree
// to a fiftieth of the extent of all, since models without control bend; what is off by less shows
// after adjustment. `is_upright`: the scene is in a metric frame held by positions or gimbals, of
// which little turning is expected; without it three points that agree cannot outvote a fourth.
ControlFit FitControl(std::span<const PointPair> pairs, bool is_upright);

}  // namespace stucco
