// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/town.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "simulate/city/design_wall.h"
#include "simulate/city/footprints.h"
#include "simulate/city/internal/layouts.h"
#include "simulate/city/make_city.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::simulate {
namespace internal {

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
      for (const OutlineEdge& theirs : EdgesOf(other.outline)) {
        for (size_t i = 0; i < edges.size(); ++i) {
          if (edges[i].a == theirs.b && edges[i].b == theirs.a) house.party[i] = true;
        }
      }
    }
  }
}

bool KeepsApart(const Polygon& outline, const std::vector<House>& houses, double least_m) {
  return std::all_of(houses.begin(), houses.end(),
                     [&](const House& house) { return Gap(outline, house.outline) >= least_m; });
}

namespace {

// How far a trunk keeps from walls: crowns bulge beyond their radius, and leaves stand out of them.
double RoomFor(const Tree& tree) {
  return 1.2 * tree.crown_m + 0.8;
}

}  // namespace

void PlantTrees(const Eigen::Vector2d& low, const Eigen::Vector2d& high, int count, Random& random,
                Town& town, const TreeHeights& heights) {
  constexpr int kTries = 20;
  for (int i = 0; i < count * kTries && count > 0; ++i) {
    Tree tree;
    tree.position = {random.Uniform(low.x(), high.x()), random.Uniform(low.y(), high.y())};
    tree.height_m = random.Uniform(heights.from_m, heights.to_m);
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

}  // namespace internal

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
  return town;
}

std::vector<std::string> CityStyles() {
  return {"hamlet", "block", "asia", "campus", "terrain"};
}

}  // namespace stucco::simulate
