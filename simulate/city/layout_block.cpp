// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "simulate/city/footprints.h"
#include "simulate/city/internal/layouts.h"

namespace stucco::simulate::internal {
namespace {

using Eigen::Vector2d;

constexpr double kPavement_m = 3;

// A perimeter block about the origin.
struct Perimeter {
  double width = 70;
  double height = 56;
  double depth = 12;   // of its buildings
  double corner = 18;  // along the street, of the buildings at its corners
};

void SetRoof(RoofShape shape, Random& random, House& house) {
  house.roof = shape;
  if (shape == RoofShape::kFlat) {
    house.covering = random.Chance(0.5) ? Covering::kMembrane : Covering::kGravel;
  } else {
    house.covering = random.Chance(0.75) ? Covering::kTiles : Covering::kMetal;
  }
}

House MakeTenement(Random& random) {
  House house;
  house.use = HouseUse::kTenement;
  house.storeys = random.Integer(3, 6);
  house.storey_m = random.Uniform(3, 3.5);
  house.floor_m = random.Uniform(0.3, 0.7);
  house.palette = random.Index(1000);
  constexpr std::array kCladdings = {Cladding::kPlaster, Cladding::kBrick, Cladding::kStone,
                                     Cladding::kPlaster, Cladding::kConcrete};
  house.cladding = kCladdings[random.Index(kCladdings.size())];
  const RoofShape roof = random.Chance(0.6) ? RoofShape::kGabled : RoofShape::kFlat;
  house.slope = random.Uniform(0.55, 0.85);
  house.parapet_m = random.Uniform(0.3, 0.6);
  SetRoof(roof, random, house);
  return house;
}

void AddTenement(Polygon outline, const std::vector<Vector2d>& streets, Random& random,
                 Town& town) {
  House house = MakeTenement(random);
  house.outline = std::move(outline);
  ClearEdges(house);
  for (const Vector2d& street : streets) MarkFront(street, house);
  town.houses.push_back(std::move(house));
}

// Corner buildings are Ls whose outer corner is the block's.
void AddCorners(const Perimeter& block, Random& random, Town& town) {
  const double x = block.width / 2;
  const double y = block.height / 2;
  const double c = block.corner;
  const double d = block.depth;
  AddTenement(
      {{{{-x, -y}, {c - x, -y}, {c - x, d - y}, {d - x, d - y}, {d - x, c - y}, {-x, c - y}}}},
      {{0, -1}, {-1, 0}}, random, town);
  AddTenement(
      {{{{x - c, -y}, {x, -y}, {x, c - y}, {x - d, c - y}, {x - d, d - y}, {x - c, d - y}}}},
      {{0, -1}, {1, 0}}, random, town);
  AddTenement({{{{x, y}, {x - c, y}, {x - c, y - d}, {x - d, y - d}, {x - d, y - c}, {x, y - c}}}},
              {{0, 1}, {1, 0}}, random, town);
  AddTenement(
      {{{{-x, y}, {-x, y - c}, {d - x, y - c}, {d - x, y - d}, {c - x, y - d}, {c - x, y}}}},
      {{0, 1}, {-1, 0}}, random, town);
}

// Cuts a row into lots of 11.5 to 15 m, or a little more or less, so that they fill it.
std::vector<double> Lots(double from, double to, Random& random) {
  const double length = to - from;
  const int count = std::max(1, static_cast<int>(std::lround(length / random.Uniform(11.5, 15))));
  std::vector<double> cuts = {from};
  for (int i = 1; i < count; ++i) {
    cuts.push_back(from + length * (i + random.Uniform(-0.12, 0.12)) / count);
  }
  cuts.push_back(to);
  return cuts;
}

void AddRows(const Perimeter& block, Random& random, Town& town) {
  const double x = block.width / 2;
  const double y = block.height / 2;
  const double c = block.corner;
  const double d = block.depth;
  // On one side, where it has several lots, one is free: a way into the courtyard, with fire walls
  // at its sides.
  const int free_side = random.Index(4);
  for (int side = 0; side < 4; ++side) {
    const bool level = side % 2 == 0;  // south and north
    const double half = level ? x : y;
    const std::vector<double> cuts = Lots(c - half, half - c, random);
    const int lots = static_cast<int>(cuts.size()) - 1;
    const int free = side == free_side && lots > 1 ? random.Index(lots) : -1;
    for (int i = 0; i < lots; ++i) {
      if (i == free) continue;
      const double a = cuts[i];
      const double b = cuts[i + 1];
      if (side == 0)
        AddTenement({{{{a, -y}, {b, -y}, {b, d - y}, {a, d - y}}}}, {{0, -1}}, random, town);
      if (side == 1)
        AddTenement({{{{x - d, a}, {x, a}, {x, b}, {x - d, b}}}}, {{1, 0}}, random, town);
      if (side == 2)
        AddTenement({{{{a, y - d}, {b, y - d}, {b, y}, {a, y}}}}, {{0, 1}}, random, town);
      if (side == 3)
        AddTenement({{{{-x, a}, {d - x, a}, {d - x, b}, {-x, b}}}}, {{-1, 0}}, random, town);
    }
  }
}

// Across the street: a building around a courtyard of its own.
void AddPalace(double x, Random& random, Town& town) {
  House house = MakeTenement(random);
  house.storeys = random.Integer(3, 4);
  const double wing = random.Uniform(9, 10.5);
  const double y = random.Uniform(-4, 4);
  const double depth = random.Uniform(36, 46);
  const double width = random.Uniform(33, 38);
  house.outline = Placed(CourtyardShape(width, depth, wing), 0, {x + 19, y});
  SetRoof(random.Chance(0.5) ? RoofShape::kHipped : RoofShape::kFlat, random, house);
  ClearEdges(house);
  for (const Vector2d& side : {Vector2d(-1, 0), Vector2d(1, 0), Vector2d(0, 1), Vector2d(0, -1)}) {
    MarkFront(side, house);
  }
  town.houses.push_back(std::move(house));
}

void AddStreets(const Perimeter& block, double street, Random& random, Town& town) {
  const double x = block.width / 2;
  const double y = block.height / 2;
  const double k = kPavement_m;
  const double east = x + street + 42;          // behind the building across the street
  const double a = std::max(y + street, 31.0);  // the far kerb in the north and south
  const auto add = [&](const Vector2d& low, const Vector2d& high, Covering covering, double raise) {
    town.ground.push_back({low, high, covering, raise});
  };
  // From the inside out: the courtyard, islands of pavement, streets, pavements across, a park.
  const Vector2d court(x - block.depth - 2, y - block.depth - 2);
  add(-court, court, Covering::kGrass, 0);
  add({-x - k, -y - k}, {x + k, y + k}, Covering::kPaving, 0);
  add({x + street - k, -28}, {east, 28}, Covering::kPaving, 0);
  add({-x - street, -a}, {east + street, a}, Covering::kAsphalt, -0.12);
  add({-x - street - k, -a - k}, {east + street + k, a + k}, Covering::kPaving, 0);
  add({-x - street - 16, -a - 16}, {east + street + 16, a + 16}, Covering::kGrass, 0);
  ParkCars({-x, -y - k - 1.2}, {x, -y - k - 1.2}, 0.55, random, town);
  ParkCars({-x, y + k + 1.2}, {x, y + k + 1.2}, 0.55, random, town);
  ParkCars({-x - k - 1.2, -y}, {-x - k - 1.2, y}, 0.5, random, town);
  ParkCars({x + k + 1.2, -y}, {x + k + 1.2, y}, 0.5, random, town);
}

}  // namespace

Town LayOutBlock(Random random) {
  Town town;
  town.turn_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  Perimeter block;
  block.width = random.Uniform(64, 76);
  block.height = random.Uniform(52, 60);
  block.depth = random.Uniform(11, 13);
  block.corner = block.depth + random.Uniform(7, 9);
  const double street = random.Uniform(16, 20);
  AddCorners(block, random, town);
  AddRows(block, random, town);
  AddPalace(block.width / 2 + street, random, town);
  AddStreets(block, street, random, town);
  const double x = block.width / 2;
  const double y = block.height / 2;
  const Vector2d court(x - block.depth, y - block.depth);
  PlantTrees({-court, court, 5}, random, town);
  const double park = std::max(y + street, 31.0) + kPavement_m;
  PlantTrees({{-x - street, park + 1}, {x + street, park + 13}, 9}, random, town);
  PlantTrees({{-x - street, -park - 13}, {x + street, -park - 1}, 9}, random, town);
  PlantTrees({{-x - street - 14, -y}, {-x - street - 4, y}, 6}, random, town);
  // Young trees at the kerb, before the facades.
  PlantTrees({{-x, -y - 2.4}, {x, -y - 2.2}, 5, 4, 5.2}, random, town);
  PlantTrees({{-x - 2.4, -y}, {-x - 2.2, y}, 4, 4, 5.2}, random, town);
  return town;
}

}  // namespace stucco::simulate::internal
