// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/shared_length.h"

#include <algorithm>
#include <cmath>

namespace stucco {

double SharedLength(const Segment2d& line, const Segment2d& other, double reach, Heading heading) {
  constexpr double kParallel = 0.97;
  const Eigen::Vector2d along = (line.b - line.a).normalized();
  const Eigen::Vector2d theirs = (other.b - other.a).normalized();
  if (along.dot(theirs) * (heading == Heading::kOpposite ? -1 : 1) < kParallel) return 0;
  const double a = along.dot(other.a - line.a), b = along.dot(other.b - line.a);
  const double from = std::max(0.0, std::min(a, b));
  const double to = std::min((line.b - line.a).norm(), std::max(a, b));
  if (!(to > from)) return 0;
  const Eigen::Vector2d middle = line.a + (from + to) / 2 * along;
  return std::abs(Cross(theirs, middle - other.a)) < reach ? to - from : 0;
}

}  // namespace stucco
