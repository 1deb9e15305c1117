// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/paint/car_shape.h"

#include <algorithm>

#include "simulate/random.h"

namespace stucco::simulate {

double CarShape::HalfWidth(const Eigen::Vector2d& at) const {
  const double belt = outline[windscreen].y();
  const double lean = 0.22 * std::max(0.0, belt - at.y()) / belt;
  constexpr double kRound_m = 0.5;
  const double to_end = std::min(at.x(), kCarLength_m - at.x());
  const double round = 0.1 * std::max(0.0, 1 - to_end / kRound_m);
  return kCarWidth_m / 2 - lean - round;
}

CarShape ShapeOfCar(uint64_t seed) {
  CarShape shape;
  shape.outline = {{0.12, 1.30}, {0.03, 1.05}, {0.05, 0.86}, {0.25, 0.74},
                   {1.05, 0.62}, {1.66, 0.16}, {2.3, 0.10}};
  shape.windscreen = 4;
  std::vector<Eigen::Vector2d> tail;
  switch (Random(seed, 3).Index(3)) {
    case 0:  // hatchback
      tail = {{3.1, 0.12}, {3.7, 0.22}, {4.18, 0.66}, {4.34, 0.80}};
      break;
    case 1:  // saloon
      tail = {{2.8, 0.13}, {3.1, 0.18}, {3.68, 0.60}, {4.32, 0.66}};
      break;
    default:  // estate
      tail = {{3.4, 0.12}, {4.05, 0.19}, {4.28, 0.64}, {4.36, 0.80}};
      break;
  }
  shape.outline.insert(shape.outline.end(), tail.begin(), tail.end());
  shape.outline.push_back({4.38, 1.06});
  shape.outline.push_back({4.28, 1.30});
  shape.rear_window = 8;
  return shape;
}

}  // namespace stucco::simulate
