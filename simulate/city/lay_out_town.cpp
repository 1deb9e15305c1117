// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/lay_out_town.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <numbers>

#include "simulate/city/design_wall.h"
#include "simulate/city/footprints.h"
#include "simulate/city/internal/layouts.h"
#include "survey/error.h"

namespace stucco::simulate {
namespace {

Town InStreetAxes(const std::string& style, const Random& random) {
  if (style == "hamlet") return internal::LayOutHamlet(random);
  if (style == "terrain") return internal::LayOutTerrain(random);
  if (style == "block") return internal::LayOutBlock(random);
  if (style == "asia") return internal::LayOutAsia(random);
  if (style == "campus") return internal::LayOutCampus(random);
  throw Error(ErrorKind::kUsage, fmt::format("--style {}: is not known", style),
              fmt::format("choose from {}", fmt::join(CityStyles(), ", ")));
}

void Turn(Town& town) {
  const Eigen::Rotation2Dd turn(town.turn_rad);
  for (House& house : town.houses) {
    house.outline = Placed(house.outline, town.turn_rad, Eigen::Vector2d::Zero());
  }
  for (Tree& tree : town.trees) tree.position = turn * tree.position;
  for (Car& car : town.cars) {
    car.position = turn * car.position;
    car.heading_rad += town.turn_rad;
  }
}

// Puts houses on the ground: their walls start at its lowest point along the outline, and the
// ground floor lies above the highest.
void Settle(const Relief& relief, House& house) {
  double low = relief.HeightAt(house.outline.rings[0][0]);
  double high = low;
  for (const Ring& ring : house.outline.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      constexpr int kSteps = 8;
      for (int k = 0; k < kSteps; ++k) {
        const double t = static_cast<double>(k) / kSteps;
        const double z = relief.HeightAt(ring[i] + t * (ring[(i + 1) % ring.size()] - ring[i]));
        low = std::min(low, z);
        high = std::max(high, z);
      }
    }
  }
  house.base_m += low;
  house.floor_m += high;
}

// Houses have balconies, or not, once they have their seeds: trees that were planted before and
// would grow into one are taken away.
void FellTrees(Town& town) {
  constexpr double kBalcony_m = 1.5;
  std::erase_if(town.trees, [&](const Tree& tree) {
    return std::any_of(town.houses.begin(), town.houses.end(), [&](const House& house) {
      return HasBalconies(house) &&
             DistanceToOutline(house.outline, tree.position) < internal::RoomFor(tree) + kBalcony_m;
    });
  });
}

}  // namespace

Town LayOutTown(const std::string& style, uint64_t seed) {
  uint64_t name = 14695981039346656037u;  // FNV-1a: a style has towns of its own
  for (const char c : style) name = (name ^ static_cast<unsigned char>(c)) * 1099511628211u;
  Random random(seed, name);
  Town town = InStreetAxes(style, random);
  town.seed = random.Next();
  internal::MarkPartyWalls(town.houses);
  Turn(town);
  for (size_t i = 0; i < town.houses.size(); ++i) {
    House& house = town.houses[i];
    house.id = fmt::format("B{:04}", i + 1);
    house.seed = Random(seed, 1000 + i).Next();
    Settle(town.relief, house);
  }
  FellTrees(town);
  for (size_t i = 0; i < town.cars.size(); ++i) town.cars[i].number = static_cast<int>(i);
  return town;
}

std::vector<std::string> CityStyles() {
  return {"hamlet", "block", "asia", "campus", "terrain"};
}

}  // namespace stucco::simulate
