// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "survey/pose.h"

namespace stucco::evaluate {

struct Alignment {
  Similarity target_from_source;
  std::vector<bool> used;  // false: too far off to have a say
};

// The least-squares similarity of all points but gross errors: those more than ten times as far off
// as the median of a fit that half of the points suffice for (least median of squares, Rousseeuw
// 1984). Without such errors it is AlignPoints of all. Nothing for under three points or points on
// one line. Requires as many of both.
std::optional<Alignment> AlignRobustly(const Eigen::Matrix3Xd& source,
                                       const Eigen::Matrix3Xd& target);

}  // namespace stucco::evaluate
