// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "simulate/city/pitched_roof.h"
#include "simulate/paint/wall_design.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {

enum class HouseUse { kHome, kTenement, kTower, kHall };

// A building before it has walls and windows. x east, y north in the frame of the scene.
struct House {
  std::string id;  // B0001
  HouseUse use = HouseUse::kHome;
  Polygon outline;
  std::vector<bool> party;  // by edge, counted over the rings: stands against a neighbour
  std::vector<bool> front;  // by edge: towards a street
  double base_m = 0;        // z of the walls' foot, the lowest ground under it
  double floor_m = 0.2;     // z of the ground floor
  int storeys = 2;
  double storey_m = 3;
  RoofShape roof = RoofShape::kGabled;
  double slope = 0.8;      // of pitched roofs
  double parapet_m = 0.3;  // of flat ones
  double overhang_m = 0.4;
  Cladding cladding = Cladding::kPlaster;
  Covering covering = Covering::kTiles;
  int palette = 0;
  // Every bay of every storey looks the same, to the texel: no balconies, shops or doors.
  bool repeats = false;
  int repainted_edge = -1;  // the wall that has a new coat of paint; -1: none
  uint64_t seed = 0;

  double eaves_m() const { return floor_m + storeys * storey_m; }
};

// Ground in one covering: a rectangle that earlier ones of the list take away from later ones.
struct GroundPatch {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
  Covering covering = Covering::kGrass;
  double raise_m = 0;  // above the terrain: roads lie lower than pavements
};

struct Tree {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double height_m = 8;
  double crown_m = 2.5;  // radius
};

struct Car {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  double heading_rad = 0;  // of its nose, counter-clockwise from east
  int number = 0;          // in the town; with the town's seed it decides the car's looks
};

// The ground without roads: 0 everywhere, or a slope with waves.
struct Relief {
  double rise = 0;           // metres in a metre
  double direction_rad = 0;  // uphill
  double wave_m = 0;         // amplitude
  double wave_length_m = 60;

  bool IsFlat() const { return rise == 0 && wave_m == 0; }
  double HeightAt(const Eigen::Vector2d& position) const;
};

struct Town {
  uint64_t seed = 0;  // of what is no house
  std::vector<House> houses;
  // The ground is laid out in axes turned by `turn_rad` counter-clockwise about the origin.
  double turn_rad = 0;
  std::vector<GroundPatch> ground;
  std::vector<Tree> trees;  // in the frame of the scene, as houses and cars
  std::vector<Car> cars;
  Relief relief;
};

// The first patch over a place in the axes of the ground, or the number of patches: open fields.
int PatchAt(const Town& town, const Eigen::Vector2d& in_street_axes);

// z of the ground, streets and pavements included, at a place in the frame of the scene.
double GroundAt(const Town& town, const Eigen::Vector2d& position);

}  // namespace stucco::simulate
