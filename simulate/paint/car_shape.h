// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

namespace stucco::simulate {

// What the picture of a parked car and its mesh have in common. From the side: x from the nose to
// the tail, y down from kCarHeight_m above the ground.
inline constexpr double kCarLength_m = 4.4;
inline constexpr double kCarHeight_m = 1.5;
inline constexpr double kCarWidth_m = 1.76;

// The picture has the car's side at the top; below it from left to right the nose and the tail, as
// seen from before and behind; and at the bottom the car from above, its left side upwards.
inline constexpr double kCarEndsTop_m = kCarHeight_m;
inline constexpr double kCarRoofTop_m = 2 * kCarHeight_m;
inline constexpr double kCarPicture_m = kCarRoofTop_m + kCarWidth_m;  // its height

struct CarShape {
  // From the foot of the nose over bonnet and roof to the foot of the tail.
  std::vector<Eigen::Vector2d> outline;
  int windscreen = 0;   // the corner at its foot; the next is its top
  int rear_window = 0;  // the corner at its top; the next is its foot

  // Half the car's width at a corner: cabins lean inwards, and corners are round.
  double HalfWidth(const Eigen::Vector2d& at) const;
};

CarShape ShapeOfCar(uint64_t seed);  // hatchbacks, saloons, estates

}  // namespace stucco::simulate
