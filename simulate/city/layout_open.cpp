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

Polygon TowerOutline(Random& random) {
  const double width = random.Uniform(17, 24);
  const double depth = random.Uniform(14, 20);
  switch (random.Index(4)) {
    case 0:
      return Rectangle(width, depth);
    case 1:
      return CrossShape(width, depth, random.Uniform(3, 4.5));
    case 2:
      return LShape(width, depth + 2, random.Uniform(9, 11));
    default:
      return UShape(width + 2, depth, random.Uniform(6.5, 7.5));
  }
}

House MakeTower(Random& random) {
  House house;
  house.use = HouseUse::kTower;
  house.storeys = random.Integer(10, 25);
  house.storey_m = random.Uniform(2.9, 3.1);
  house.floor_m = random.Uniform(0.3, 1);
  house.roof = RoofShape::kFlat;
  house.parapet_m = random.Uniform(0.6, 1.1);
  house.covering = random.Chance(0.5) ? Covering::kGravel : Covering::kMembrane;
  constexpr std::array kCladdings = {Cladding::kPanels, Cladding::kConcrete, Cladding::kPlaster,
                                     Cladding::kGlass, Cladding::kBrick};
  house.cladding = kCladdings[random.Index(kCladdings.size())];
  house.palette = random.Index(1000);
  return house;
}

}  // namespace

Town LayOutAsia(Random random) {
  Town town;
  town.turn_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  // Cells hold a tower each, so that 14 m at least are between neighbours.
  const double cell_x = random.Uniform(42, 46);
  const double cell_y = random.Uniform(38, 42);
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      if (row * column != 0 && random.Chance(0.15)) continue;
      House house = MakeTower(random);
      Polygon outline = TowerOutline(random);
      if (random.Chance(0.5)) outline = Mirrored(std::move(outline));
      const double aside = random.Uniform(-1, 1);
      const double ahead = random.Uniform(-1, 1);
      const double turn = random.Chance(0.5) ? 0 : std::numbers::pi;
      house.outline =
          Placed(std::move(outline), turn, {column * cell_x + aside, row * cell_y + ahead});
      ClearEdges(house);
      MarkFront({0, -1}, house);
      town.houses.push_back(std::move(house));
    }
  }
  const double x = 1.5 * cell_x + 4;
  const double y = 1.5 * cell_y + 4;
  const double lane = random.Uniform(5, 6.5);
  for (const double side : {-0.5, 0.5}) {
    const double at = side * cell_y;
    town.ground.push_back({{-x, at - lane / 2}, {x, at + lane / 2}, Covering::kAsphalt, -0.1});
    ParkCars({-x, at + lane / 2 - 1.1}, {x, at + lane / 2 - 1.1}, 0.4, random, town);
  }
  for (int row = -1; row <= 1; ++row) {
    for (const double side : {-0.5, 0.5}) {  // lawns in the paving, between neighbours of a row
      const Vector2d middle(side * cell_x, row * cell_y);
      town.ground.push_back(
          {middle - Vector2d(5, 11), middle + Vector2d(5, 11), Covering::kGrass, 0});
    }
  }
  town.ground.push_back(
      {{-x, -y}, {x, y}, random.Chance(0.5) ? Covering::kPaving : Covering::kGrass, 0});
  town.ground.push_back({{-x - 14, -y - 14}, {x + 14, y + 14}, Covering::kAsphalt, -0.1});
  PlantTrees({{-x, -y}, {x, y}, 14}, random, town);
  std::erase_if(town.trees, [&](const Tree& tree) {
    return std::abs(std::abs(tree.position.y()) - cell_y / 2) < lane / 2 + 0.5;
  });
  return town;
}

Town LayOutCampus(Random random) {
  Town town;
  town.turn_rad = random.Uniform(-std::numbers::pi, std::numbers::pi);
  const std::array<Vector2d, 6> places = {
      {{-80, -48}, {0, -50}, {80, -46}, {-78, 46}, {4, 48}, {82, 46}}};
  const int shift = random.Index(4);
  for (size_t i = 0; i < places.size(); ++i) {
    House house;
    house.use = HouseUse::kHall;
    house.storeys = random.Integer(2, 5);
    house.storey_m = random.Uniform(3.3, 3.9);
    house.floor_m = random.Uniform(0.2, 0.6);
    house.palette = random.Index(1000);
    const double width = random.Uniform(36, 52);
    const double depth = random.Uniform(30, 40);
    const double wing = random.Uniform(10.5, 13);
    switch ((i + shift) % 4) {
      case 0:
        house.outline = LShape(width, depth, wing);
        break;
      case 1:
        house.outline = UShape(width, depth, wing);
        break;
      case 2:
        house.outline = CourtyardShape(width, depth, wing * 0.8);
        break;
      default:
        house.outline = TShape(width, depth, wing);
        break;
    }
    if (random.Chance(0.5)) house.outline = Mirrored(std::move(house.outline));
    const double ahead = random.Uniform(-4, 4);
    const double aside = random.Uniform(-4, 4);
    const int quarters = random.Index(4);
    const double askew = random.Uniform(-0.12, 0.12);
    house.outline = Placed(std::move(house.outline), std::numbers::pi / 2 * quarters + askew,
                           places[i] + Vector2d(aside, ahead));
    house.roof = random.Chance(0.6)   ? RoofShape::kFlat
                 : random.Chance(0.5) ? RoofShape::kHipped
                                      : RoofShape::kGabled;
    house.slope = random.Uniform(0.35, 0.55);
    house.parapet_m = random.Uniform(0.4, 0.8);
    house.covering = house.roof == RoofShape::kFlat ? Covering::kMembrane
                     : random.Chance(0.5)           ? Covering::kMetal
                                                    : Covering::kTiles;
    constexpr std::array kCladdings = {Cladding::kBrick, Cladding::kConcrete, Cladding::kPanels,
                                       Cladding::kGlass, Cladding::kStone};
    house.cladding = kCladdings[random.Index(kCladdings.size())];
    ClearEdges(house);
    MarkFront({0, i < 3 ? 1.0 : -1.0}, house);
    town.houses.push_back(std::move(house));
  }
  town.ground.push_back({{-125, -4}, {125, 4}, Covering::kAsphalt, -0.1});
  town.ground.push_back({{-125, -6.5}, {125, 6.5}, Covering::kPaving, 0});
  for (const double x : {-41.0, 41.0}) {
    town.ground.push_back({{x - 1.8, -80}, {x + 1.8, 80}, Covering::kPaving, 0});
  }
  town.ground.push_back({{-125, -90}, {125, 90}, Covering::kGrass, 0});
  ParkCars({-110, 2.9}, {110, 2.9}, 0.25, random, town);
  PlantTrees({{-110, 8}, {110, 80}, 18}, random, town);
  PlantTrees({{-110, -80}, {110, -8}, 18}, random, town);
  return town;
}

}  // namespace stucco::simulate::internal
