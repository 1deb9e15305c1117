// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/city/town.h"
#include "simulate/random.h"

namespace stucco::simulate::internal {

// One function per style, in axes along its streets; LayOutTown turns and numbers the houses.
Town LayOutHamlet(Random random);
Town LayOutTerrain(Random random);
Town LayOutBlock(Random random);
Town LayOutAsia(Random random);
Town LayOutCampus(Random random);

// Party and front flags, none set, for a house with its outline.
void ClearEdges(House& house);
// Edges of the outer ring whose outward normal is within 30 degrees of `direction` face a street.
void MarkFront(const Eigen::Vector2d& direction, House& house);
// Edges that two houses share, from corner to corner.
void MarkPartyWalls(std::vector<House>& houses);

bool KeepsApart(const Polygon& outline, const std::vector<House>& houses, double least_m);

// How far a trunk keeps from walls: crowns bulge beyond their radius, and leaves stand out of them.
double RoomFor(const Tree& tree);

// Trees at random places of a rectangle, away from houses and from each other.
struct Grove {
  Eigen::Vector2d low, high;
  int count = 0;
  double height_from_m = 5;
  double height_to_m = 11;
};
void PlantTrees(const Grove& grove, Random& random, Town& town);
// Cars along a kerb from `from` to `to`, with gaps.
void ParkCars(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double share, Random& random,
              Town& town);

}  // namespace stucco::simulate::internal
