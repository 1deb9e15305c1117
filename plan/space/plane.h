// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <optional>

#include "survey/plan.h"

namespace stucco::plan {

struct Segment2 {
  Eigen::Vector2d a = Eigen::Vector2d::Zero();
  Eigen::Vector2d b = Eigen::Vector2d::Zero();
};

inline double Cross(const Eigen::Vector2d& u, const Eigen::Vector2d& v) {
  return u.x() * v.y() - u.y() * v.x();
}

// All distances are squared: the square root is left to whoever needs it.
double SquaredDistance(const Eigen::Vector2d& point, const Segment2& segment);
double SquaredDistance(const Segment2& s, const Segment2& t);

// The part of s (0 at a, 1 at b) that is nearer than `radius` to t. It is one interval, as the
// points near a segment form a convex set.
std::optional<Interval> PartNear(const Segment2& s, const Segment2& t, double radius);

}  // namespace stucco::plan
