// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/stable_ids.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <map>
#include <string>
#include <utility>

#include "proxy/abstract.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using Eigen::Vector3d;
using test::FlatHouse;
using test::Rectangle;

// A wall of 3 m height along a line, seen from above with the building on its left.
Facet Wall(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double low,
           const std::string& facade) {
  Facet facet;
  const Eigen::Vector2d along = (b - a).normalized();
  facet.normal = {along.y(), -along.x(), 0};
  facet.offset = facet.normal.head<2>().dot(a);
  facet.outer = {
      {a.x(), a.y(), low}, {b.x(), b.y(), low}, {b.x(), b.y(), low + 3}, {a.x(), a.y(), low + 3}};
  if (!facade.empty()) facet.planned_facades = {facade};
  return facet;
}

Facet Roof(const Vector3d& middle, double half) {
  Facet facet;
  facet.facet_class = FacetClass::kRoof;
  facet.offset = middle.z();
  for (const auto& [x, y] : {std::pair(-1, -1), {1, -1}, {1, 1}, {-1, 1}}) {
    facet.outer.push_back(middle + half * Vector3d(x, y, 0));
  }
  return facet;
}

TEST(AssignIdsByPlace, PartsOfAFacadeCountAlongTheWall) {
  Building building{.id = "B0012", .source = "map", .detail = {}, .facets = {}};
  // Along the north side the building on the left is to walk west.
  building.facets = {Wall({4, 8}, {0, 8}, 0, "B0012/F02"), Wall({2, 5}, {4, 5}, 3, ""),
                     Wall({10, 8}, {4, 8}, 0, "B0012/F02"), Wall({0, 0}, {10, 0}, 3, "B0012/F00"),
                     Wall({0, 0}, {10, 0}, 0, "B0012/F00")};
  const std::vector<Facet> before = building.facets;
  AssignIdsByPlace(building);
  std::map<std::string, Vector3d> first_corner;
  for (const Facet& facet : building.facets) first_corner[facet.id] = facet.outer[0];
  ASSERT_EQ(first_corner.size(), 5u);
  EXPECT_EQ(first_corner.at("B0012/F02.1"), before[2].outer[0]);
  EXPECT_EQ(first_corner.at("B0012/F02.2"), before[0].outer[0]);
  EXPECT_EQ(first_corner.at("B0012/F00.1"), before[4].outer[0]);
  EXPECT_EQ(first_corner.at("B0012/F00.2"), before[3].outer[0]);
  EXPECT_EQ(first_corner.at("B0012/W00"), before[1].outer[0]);
}

TEST(AssignIdsByPlace, RoofsKeepTheirsWhateverTheirSize) {
  Building small_first{.id = "B0001", .source = "map", .detail = {}, .facets = {}};
  small_first.facets = {Roof({0, 4, 6}, 1), Roof({0, -4, 6}, 3), Roof({9, 0, 6}, 2)};
  Building large_first = small_first;
  std::reverse(large_first.facets.begin(), large_first.facets.end());
  for (Facet& facet : large_first.facets) {
    // The same places, seen a little otherwise, and with a corner amid an edge.
    const Vector3d first = facet.outer[0];
    for (Vector3d& p : facet.outer) p += 0.03 * (p - first) + Vector3d(0.02, 0.02, 0);
    facet.outer.insert(facet.outer.begin() + 1, (facet.outer[0] + facet.outer[1]) / 2);
  }
  AssignIdsByPlace(small_first);
  AssignIdsByPlace(large_first);
  for (size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(small_first.facets[i].id, "B0001/R" + std::to_string(i));
    EXPECT_EQ(large_first.facets[i].id, small_first.facets[i].id);
    EXPECT_LT((large_first.facets[i].outer[0] - small_first.facets[i].outer[0]).norm(), 0.1);
  }
  EXPECT_NEAR(small_first.facets[0].outer[0].y(), -7, 1e-12);  // south before north
}

TEST(AssignIdsByPlaceDeathTest, RequiresWallsThatStand) {
  Building building{.id = "B0012", .source = "map", .detail = {}, .facets = {}};
  building.facets = {Wall({0, 0}, {10, 0}, 0, "B0012/F00")};
  building.facets[0].normal = Vector3d::UnitZ();
  EXPECT_DEATH(AssignIdsByPlace(building), "StandsUpright");
}

// The middle of what carries each id.
std::map<std::string, Vector3d> Places(uint64_t seed) {
  test::House tall = FlatHouse(Rectangle(-8, -5, 0, 5), 8);
  test::House low = FlatHouse(Rectangle(0, -5, 8, 0), 5);
  low.polygons.erase(low.polygons.begin() + 3);  // inside of the tall wing
  const test::Captured captured = test::Capture({tall, low}, {test::GroundSquare(25)},
                                                {.spacing = 0.2, .noise = 0.02, .seed = seed});
  ProxyInput input = test::InputOf(captured, test::MapGeoref());
  input.plan = test::PlanOf({{"B0001", {{{-8, -5}, {8, -5}, {8, 0}, {0, 0}, {0, 5}, {-8, 5}}}, 8}});
  ProxyFindings findings;
  const Proxy proxy = AbstractCloud(input, {}, 2, findings);
  std::map<std::string, Vector3d> places;
  const Building* building = test::Find(proxy, "B0001");
  if (building == nullptr) return places;
  for (const Facet& facet : building->facets) {
    Vector3d& middle = places.try_emplace(facet.id, Vector3d::Zero()).first->second;
    for (const Vector3d& p : facet.outer) middle += p / static_cast<double>(facet.outer.size());
  }
  return places;
}

TEST(AssignIdsByPlace, AnotherCloudOfABuildingGetsTheSameIds) {
  const auto places = Places(1);
  ASSERT_GE(places.size(), 9u);
  for (const char* id : {"B0001/F00.1", "B0001/F05.1", "B0001/R0", "B0001/R1", "B0001/G0"}) {
    EXPECT_TRUE(places.contains(id)) << id;
  }
  for (const uint64_t seed : {2, 3}) {
    const auto others = Places(seed);
    ASSERT_EQ(others.size(), places.size());
    for (const auto& [id, middle] : places) {
      ASSERT_TRUE(others.contains(id)) << id;
      EXPECT_LT((others.at(id) - middle).norm(), 0.2) << id;
    }
  }
}

}  // namespace
}  // namespace stucco
