// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/later_day.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <optional>

#include "simulate/city/footprints.h"
#include "simulate/city/occluders.h"
#include "simulate/random.h"

namespace stucco::simulate {
namespace {

constexpr uint64_t kDaySeed = 0xDA7;
constexpr double kNarrowest_m = 4;  // of walls that are repainted
constexpr double kPlace_m = 5.8;    // from one parked car to the next
constexpr double kCarRoom_m = 5;    // between middles of cars
constexpr double kRoom_m = 3;       // from the middle of a car to what is no car

struct Wall {
  size_t house = 0;
  int edge = 0;
};

std::vector<Wall> WallsToPaint(const Town& town, const FacadeIds& facades) {
  std::vector<Wall> walls;
  for (size_t i = 0; i < town.houses.size(); ++i) {
    const House& house = town.houses[i];
    if (house.cladding == Cladding::kGlass) continue;
    const std::vector<OutlineEdge> edges = EdgesOf(house.outline);
    for (size_t edge = 0; edge < edges.size(); ++edge) {
      if (facades[i][edge].empty()) continue;
      if ((edges[edge].b - edges[edge].a).norm() < kNarrowest_m) continue;
      walls.push_back({i, static_cast<int>(edge)});
    }
  }
  return walls;
}

bool IsFree(const Town& town, const Eigen::Vector2d& place) {
  const auto is_far = [&](const Eigen::Vector2d& from, double least_m) {
    return (from - place).norm() >= least_m;
  };
  return std::ranges::all_of(town.cars,
                             [&](const Car& car) { return is_far(car.position, kCarRoom_m); }) &&
         std::ranges::all_of(town.trees,
                             [&](const Tree& tree) { return is_far(tree.position, kRoom_m); }) &&
         std::ranges::all_of(town.houses, [&](const House& house) {
           return !Contains(house.outline, place) &&
                  DistanceToOutline(house.outline, place) >= kRoom_m;
         });
}

std::optional<Car> NewCar(const Town& town, Random& random) {
  std::vector<Car> places;
  for (const Car& car : town.cars) {
    for (const double step_m : {-kPlace_m, kPlace_m}) {
      Car other = car;
      other.position +=
          step_m * Eigen::Vector2d(std::cos(car.heading_rad), std::sin(car.heading_rad));
      if (IsFree(town, other.position)) places.push_back(other);
    }
  }
  if (places.empty()) return std::nullopt;
  Car car = places[random.Index(static_cast<int>(places.size()))];
  for (const Car& other : town.cars) car.number = std::max(car.number, other.number + 1);
  return car;
}

}  // namespace

DayChanges LiveUntil(int day, const FacadeIds& facades, Town& town) {
  assert(day >= 1 && facades.size() == town.houses.size());
  DayChanges changes;
  if (day == 1) return changes;
  Random random(SeedOf(town.seed, kDaySeed), static_cast<uint64_t>(day));
  const std::vector<Wall> walls = WallsToPaint(town, facades);
  if (!walls.empty()) {
    const Wall wall = walls[random.Index(static_cast<int>(walls.size()))];
    town.houses[wall.house].repainted_edge = wall.edge;
    changes.repainted.push_back(facades[wall.house][wall.edge]);
  }
  if (town.cars.empty()) return changes;
  const std::optional<Car> come = NewCar(town, random);
  const auto gone = town.cars.begin() + random.Index(static_cast<int>(town.cars.size()));
  changes.gone.push_back(ElementOf(*gone));
  town.cars.erase(gone);
  if (come) {
    town.cars.push_back(*come);
    changes.come.push_back(ElementOf(*come));
  }
  return changes;
}

}  // namespace stucco::simulate
