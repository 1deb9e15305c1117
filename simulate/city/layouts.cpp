// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/internal/layouts.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/city/footprints.h"
#include "survey/geometry2d.h"

namespace stucco::simulate::internal {
namespace {

bool IsAmong(const std::vector<OutlineEdge>& edges, const Eigen::Vector2d& a,
             const Eigen::Vector2d& b) {
  return std::any_of(edges.begin(), edges.end(),
                     [&](const OutlineEdge& edge) { return edge.a == a && edge.b == b; });
}

}  // namespace

void ClearEdges(House& house) {
  const size_t count = EdgesOf(house.outline).size();
  house.party.assign(count, false);
  house.front.assign(count, false);
}

void MarkFront(const Eigen::Vector2d& direction, House& house) {
  const double most_rad = std::numbers::pi / 6;
  const std::vector<OutlineEdge> edges = EdgesOf({{house.outline.rings[0]}});
  for (size_t i = 0; i < edges.size(); ++i) {
    if (edges[i].outward().dot(direction.normalized()) > std::cos(most_rad)) house.front[i] = true;
  }
}

void MarkPartyWalls(std::vector<House>& houses) {
  for (House& house : houses) {
    const std::vector<OutlineEdge> edges = EdgesOf(house.outline);
    for (const House& other : houses) {
      if (&other == &house) continue;
      const std::vector<OutlineEdge> theirs = EdgesOf(other.outline);
      for (size_t i = 0; i < edges.size(); ++i) {
        if (IsAmong(theirs, edges[i].b, edges[i].a)) house.party[i] = true;
      }
    }
  }
}

bool KeepsApart(const Polygon& outline, const std::vector<House>& houses, double least_m) {
  return std::all_of(houses.begin(), houses.end(),
                     [&](const House& house) { return Gap(outline, house.outline) >= least_m; });
}

double RoomFor(const Tree& tree) {
  return 1.2 * tree.crown_m + 0.8;
}

void PlantTrees(const Grove& grove, Random& random, Town& town) {
  constexpr int kTries = 20;
  int count = grove.count;
  for (int i = 0; i < count * kTries && count > 0; ++i) {
    Tree tree;
    tree.position = {random.Uniform(grove.low.x(), grove.high.x()),
                     random.Uniform(grove.low.y(), grove.high.y())};
    tree.height_m = random.Uniform(grove.height_from_m, grove.height_to_m);
    tree.crown_m = tree.height_m * random.Uniform(0.22, 0.34);
    const bool free =
        std::all_of(town.houses.begin(), town.houses.end(),
                    [&](const House& house) {
                      return !Contains(house.outline, tree.position) &&
                             DistanceToOutline(house.outline, tree.position) > RoomFor(tree);
                    }) &&
        std::all_of(town.trees.begin(), town.trees.end(), [&](const Tree& other) {
          return (other.position - tree.position).norm() > 0.8 * (other.crown_m + tree.crown_m);
        });
    if (!free) continue;
    town.trees.push_back(tree);
    if (--count == 0) return;
  }
}

void ParkCars(const Eigen::Vector2d& from, const Eigen::Vector2d& to, double share, Random& random,
              Town& town) {
  constexpr double kPlace_m = 5.8;
  const Eigen::Vector2d along = (to - from).normalized();
  const int places = static_cast<int>((to - from).norm() / kPlace_m);
  for (int i = 0; i < places; ++i) {
    if (!random.Chance(share)) continue;
    Car car;
    car.position = from + (i + 0.5 + random.Uniform(-0.08, 0.08)) * kPlace_m * along;
    const double askew = random.Uniform(-0.03, 0.03);
    const double turn = random.Chance(0.2) ? std::numbers::pi : 0;
    car.heading_rad = std::atan2(along.y(), along.x()) + askew + turn;
    town.cars.push_back(car);
  }
}

}  // namespace stucco::simulate::internal
