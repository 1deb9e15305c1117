// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/town.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco::simulate {

double Relief::HeightAt(const Eigen::Vector2d& position) const {
  const Eigen::Vector2d uphill(std::cos(direction_rad), std::sin(direction_rad));
  const Eigen::Vector2d across(-uphill.y(), uphill.x());
  const double turns = 2 * std::numbers::pi / wave_length_m;
  return rise * uphill.dot(position) + wave_m * std::sin(turns * across.dot(position)) *
                                           std::cos(0.7 * turns * uphill.dot(position));
}

int PatchAt(const Town& town, const Eigen::Vector2d& in_street_axes) {
  const auto patch =
      std::find_if(town.ground.begin(), town.ground.end(), [&](const GroundPatch& candidate) {
        return (in_street_axes.array() >= candidate.low.array()).all() &&
               (in_street_axes.array() <= candidate.high.array()).all();
      });
  return static_cast<int>(patch - town.ground.begin());
}

double GroundAt(const Town& town, const Eigen::Vector2d& position) {
  const int patch = PatchAt(town, Eigen::Rotation2Dd(-town.turn_rad) * position);
  const bool fields = patch == static_cast<int>(town.ground.size());
  return town.relief.HeightAt(position) + (fields ? 0 : town.ground[patch].raise_m);
}

}  // namespace stucco::simulate
