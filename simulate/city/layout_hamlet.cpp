// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <array>
#include <numbers>

#include "simulate/city/footprints.h"
#include "simulate/city/internal/layouts.h"

namespace stucco::simulate::internal {
namespace {

using Eigen::Vector2d;

struct Range {
  double from, to;
};

double Within(const Range& range, Random& random) {
  return random.Uniform(range.from, range.to);
}

Polygon RandomRectangle(const Range& widths, const Range& depths, Random& random) {
  const double depth = Within(depths, random);
  const double width = Within(widths, random);
  return Rectangle(width, depth);
}

Polygon RandomLShape(const Range& widths, const Range& depths, const Range& wings, Random& random) {
  const double wing = Within(wings, random);
  const double depth = Within(depths, random);
  const double width = Within(widths, random);
  return LShape(width, depth, wing);
}

// Three kinds of detached houses; a hamlet has one of each.
House MakeHome(int kind, Random& random) {
  House house;
  house.palette = random.Index(1000);
  house.storey_m = random.Uniform(2.8, 3.1);
  house.floor_m = random.Uniform(0.25, 0.5);
  switch (kind) {
    case 0:
      house.outline = RandomRectangle({9.5, 12}, {7.5, 8.8}, random);
      house.roof = RoofShape::kGabled;
      house.slope = random.Uniform(0.75, 1.1);
      house.storeys = random.Integer(1, 2);
      house.cladding = random.Chance(0.5) ? Cladding::kBrick : Cladding::kPlaster;
      break;
    case 1:
      house.outline = RandomLShape({10.5, 12.5}, {9.5, 11.5}, {5.4, 6.2}, random);
      house.roof = random.Chance(0.6) ? RoofShape::kHipped : RoofShape::kGabled;
      house.slope = random.Uniform(0.5, 0.8);
      house.storeys = random.Integer(1, 2);
      house.cladding = random.Chance(0.5) ? Cladding::kPlaster : Cladding::kStone;
      break;
    default:
      house.outline = random.Chance(0.5) ? RandomRectangle({8.5, 10.5}, {7.5, 9}, random)
                                         : RandomLShape({9.5, 11}, {9, 10}, {5.5, 6.2}, random);
      house.roof = RoofShape::kFlat;
      house.parapet_m = random.Uniform(0.25, 0.45);
      house.storeys = random.Integer(2, 3);
      house.cladding = random.Chance(0.5) ? Cladding::kConcrete : Cladding::kPlaster;
      house.covering = random.Chance(0.5) ? Covering::kGravel : Covering::kMembrane;
      break;
  }
  if (random.Chance(0.5)) house.outline = Mirrored(std::move(house.outline));
  return house;
}

void AddHomes(const std::vector<Vector2d>& places, double least_gap_m, Random& random, Town& town) {
  const int shift = random.Index(3);
  for (size_t i = 0; i < places.size(); ++i) {
    House house = MakeHome(static_cast<int>(i + shift) % 3, random);
    const Polygon outline = house.outline;
    const double quarter = std::numbers::pi / 2 * random.Index(4);
    // The neighbours were placed first; a calmer place each time ends at the middle of its lot,
    // which is free.
    constexpr int kTries = 40;
    for (int k = 0; k <= kTries; ++k) {
      const double freedom = 1 - static_cast<double>(k) / kTries;
      const Vector2d jitter = {random.Uniform(-2, 2), random.Uniform(-2, 2)};
      house.outline = Placed(outline, quarter + freedom * random.Uniform(-0.25, 0.25),
                             places[i] + freedom * jitter);
      if (KeepsApart(house.outline, town.houses, least_gap_m)) break;
    }
    ClearEdges(house);
    MarkFront({0, -1}, house);
    town.houses.push_back(std::move(house));
  }
}

void AddVillageGround(double half_m, Random& random, Town& town) {
  const double road = -half_m * 0.62;
  const double left = -half_m;
  town.ground.push_back({{left, road}, {half_m, road + 5.5}, Covering::kAsphalt, -0.1});
  town.ground.push_back({{left, road + 5.5}, {half_m, road + 7.2}, Covering::kPaving, 0});
  for (const House& house : town.houses) {  // a drive to every house
    Vector2d middle = Vector2d::Zero();
    for (const Vector2d& corner : house.outline.rings[0]) {
      middle += corner / static_cast<double>(house.outline.rings[0].size());
    }
    const double width = random.Uniform(1.4, 3);
    town.ground.push_back({{middle.x() - width / 2, road + 7.2},
                           {middle.x() + width / 2, middle.y()},
                           random.Chance(0.5) ? Covering::kPaving : Covering::kGravel,
                           0});
  }
  town.ground.push_back({{left, -half_m}, {half_m, half_m}, Covering::kGrass, 0});
  ParkCars({left + 6, road + 4.4}, {half_m - 6, road + 4.4}, 0.3, random, town);
}

}  // namespace

Town LayOutHamlet(Random random) {
  Town town;
  town.turn_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  AddHomes({{-10.5, -6}, {10.5, -5}, {random.Uniform(-4, 4), 12}}, 3.5, random, town);
  AddVillageGround(34, random, town);
  PlantTrees({{-24, -12}, {24, 26}, 7}, random, town);
  return town;
}

Town LayOutTerrain(Random random) {
  Town town;
  town.turn_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  town.relief = {.rise = random.Uniform(0.1, 0.18),
                 .direction_rad = random.Uniform(-std::numbers::pi, std::numbers::pi),
                 .wave_m = random.Uniform(0.6, 1.2),
                 .wave_length_m = random.Uniform(55, 90)};
  AddHomes({{-22, -10}, {0, -9}, {22, -11}, {-13, 14}, {12, 15}}, 5, random, town);
  AddVillageGround(48, random, town);
  PlantTrees({{-40, -20}, {40, 40}, 16}, random, town);
  return town;
}

}  // namespace stucco::simulate::internal
