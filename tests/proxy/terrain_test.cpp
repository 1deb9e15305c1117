// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/terrain/terrain.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>

#include "proxy/abstract.h"
#include "proxy/solids/closed_check.h"
#include "proxy/solids/party_walls.h"
#include "tests/proxy/map_scene.h"
#include "tests/proxy/scene.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Height = std::function<double(double x, double y)>;

double Hills(double x, double y) {
  return 0.08 * x + 1.5 * std::sin(0.15 * x) * std::cos(0.12 * y);
}

// Triangles of at most 3 m from -half to half.
std::vector<test::TruePolygon> GroundOf(double half, const Height& height) {
  constexpr double kStep = 3;
  std::vector<test::TruePolygon> ground;
  const auto at = [&](double x, double y) { return Vector3d(x, y, height(x, y)); };
  for (double y = -half; y < half; y += kStep) {
    for (double x = -half; x < half; x += kStep) {
      const double right = x + kStep, back = y + kStep;
      ground.push_back({"ground", {at(x, y), at(right, y), at(right, back)}});
      ground.push_back({"ground", {at(x, y), at(right, back), at(x, back)}});
    }
  }
  return ground;
}

// A box whose walls go down into the ground.
test::House Sunk(double top) {
  test::House house = test::BoxHouse(10, 8, top);
  for (auto& polygon : house.polygons) {
    for (Vector3d& p : polygon.ring) {
      if (p.z() < 1) p.z() = -4;
    }
  }
  return house;
}

Proxy Abstract(const test::Captured& captured, const ProxyOptions& options = {}) {
  ProxyFindings findings;
  Proxy proxy = AbstractCloud(test::InputOf(captured, test::MapGeoref()), options, 1, findings);
  EXPECT_EQ(FindProblem(proxy), std::nullopt);
  return proxy;
}

// Height of the facet above a place, where there is one: facets are triangles.
std::optional<double> HeightAt(const std::vector<Facet>& facets, const Vector2d& p) {
  for (const Facet& facet : facets) {
    Ring ring;
    for (const Vector3d& corner : facet.outer) ring.push_back(corner.head<2>());
    if (!Contains(ring, p)) continue;
    return (facet.offset - facet.normal.head<2>().dot(p)) / facet.normal.z();
  }
  return std::nullopt;
}

double AreaInPlan(const std::vector<Facet>& facets) {
  double area = 0;
  for (const Facet& facet : facets) area += facet.area * facet.normal.z();
  return area;
}

TEST(Terrain, FollowsHillsAndEndsAtTheWalls) {
  const auto captured =
      test::Capture({Sunk(7)}, GroundOf(24, Hills), {.spacing = 0.15, .noise = 0.02});
  const Proxy proxy = Abstract(captured);
  const Building* house = test::Find(proxy, "C0001");
  const Building* ground = test::Find(proxy, "G0");
  ASSERT_NE(house, nullptr);
  ASSERT_NE(ground, nullptr);
  ASSERT_TRUE(house->watertight);
  // As many triangles as the bends ask for, not as many as there are cells.
  EXPECT_GT(ground->facets.size(), 20u);
  EXPECT_LT(ground->facets.size(), 400u);
  int missing = 0, places = 0;
  double squares = 0;
  for (double y = -22; y <= 22; y += 1.1) {
    for (double x = -22; x <= 22; x += 1.1) {
      const bool built = std::abs(x) < 5.2 && std::abs(y) < 4.2;
      const auto height = HeightAt(ground->facets, {x, y});
      if (std::abs(x) < 4.8 && std::abs(y) < 3.8) {
        EXPECT_FALSE(height) << x << ", " << y;
      }
      if (built) continue;
      ++places;
      if (!height) {
        ++missing;
        continue;
      }
      EXPECT_NEAR(*height, Hills(x, y), 0.2) << x << ", " << y;
      squares += std::pow(*height - Hills(x, y), 2);
    }
  }
  EXPECT_EQ(missing, 0);
  EXPECT_LT(std::sqrt(squares / places), 0.06);
  // Without overlaps: as large as what it covers.
  EXPECT_NEAR(AreaInPlan(ground->facets), 48 * 48 - 10 * 8, 0.05 * 48 * 48);
  for (const Facet& facet : ground->facets) {
    EXPECT_EQ(facet.facet_class, FacetClass::kGround);
    EXPECT_GT(facet.normal.z(), 0.5);
  }
}

TEST(Terrain, GoesOnBelowWhatHidesIt) {
  auto ground = GroundOf(24, Hills);
  std::erase_if(ground, [](const test::TruePolygon& polygon) {
    return (polygon.ring[0].head<2>() - Vector2d(12, 10)).norm() < 4.5;
  });
  const auto captured = test::Capture({Sunk(7)}, ground, {.spacing = 0.15, .noise = 0.02});
  const Proxy proxy = Abstract(captured);
  const Building* site = test::Find(proxy, "G0");
  ASSERT_NE(site, nullptr);
  const auto height = HeightAt(site->facets, {12, 10});
  ASSERT_TRUE(height);
  EXPECT_NEAR(*height, Hills(12, 10), 0.6);
  double seen = 0, area = 0;
  for (const Facet& facet : site->facets) {
    seen += facet.seen * facet.area;
    area += facet.area;
    EXPECT_DOUBLE_EQ(facet.inferred, 1 - facet.seen);
  }
  EXPECT_LT(seen, 0.99 * area);
  EXPECT_GT(seen, 0.85 * area);
}

TEST(Terrain, LevelStepsAndSlopesStayPlanes) {
  const auto terraces = [](double x, double) { return x < 11 ? 0.0 : 1.5; };
  auto ground = GroundOf(24, terraces);
  std::erase_if(ground, [](const test::TruePolygon& polygon) {  // the bank between them
    const auto [low, high] =
        std::ranges::minmax(polygon.ring, {}, [](const Vector3d& p) { return p.z(); });
    return high.z() - low.z() > 0.1;
  });
  const Height slope = [](double x, double y) { return 0.1 * x - 0.05 * y; };
  for (const auto& made : {ground, GroundOf(24, slope)}) {
    const auto captured = test::Capture({Sunk(7)}, made, {.spacing = 0.15, .noise = 0.02});
    const Proxy proxy = Abstract(captured);
    const Building* site = test::Find(proxy, "G0");
    ASSERT_NE(site, nullptr);
    EXPECT_LE(site->facets.size(), 3u);
  }
}

TEST(Terrain, AGroundNobodySawHasNone) {
  PlanarScene scene;
  scene.tolerances.level_of_detail = 0.3;
  EXPECT_TRUE(TerrainFacets(scene, {}).empty());
}

Facet FacetOf(FacetClass facet_class, std::vector<Vector3d> corners) {
  Facet facet;
  facet.facet_class = facet_class;
  const Vector3d normal = (corners[1] - corners[0]).cross(corners[2] - corners[0]);
  facet.normal = normal.normalized();
  facet.offset = facet.normal.dot(corners[0]);
  for (size_t i = 1; i + 1 < corners.size(); ++i) {
    facet.area += (corners[i] - corners[0]).cross(corners[i + 1] - corners[0]).norm() / 2;
  }
  facet.outer = std::move(corners);
  return facet;
}

TEST(PartyWalls, WhatLiesBelowTheGroundIsHidden) {
  // A wall of 10 x 6 m that looks south; before it the ground rises from 0 in the west to 3 m.
  Building house{
      .id = "B0001", .watertight = true, .source = "map", .detail = "full", .facets = {}};
  house.facets.push_back(
      FacetOf(FacetClass::kWall, {{0, 0, 0}, {10, 0, 0}, {10, 0, 6}, {0, 0, 6}}));
  // The same to the north, where there is no ground, and a piece that is buried altogether.
  house.facets.push_back(
      FacetOf(FacetClass::kWall, {{10, 8, 0}, {0, 8, 0}, {0, 8, 6}, {10, 8, 6}}));
  house.facets.push_back(
      FacetOf(FacetClass::kWall, {{8, 0, 0}, {10, 0, 0}, {10, 0, 1}, {8, 0, 1}}));
  Building ground{.id = "G0", .watertight = false, .source = "cloud", .detail = {}, .facets = {}};
  ground.facets.push_back(
      FacetOf(FacetClass::kGround, {{-5, -20, -1.5}, {15, -20, 4.5}, {15, 0, 4.5}, {-5, 0, -1.5}}));
  std::vector<Building> buildings = {house, ground};
  MeasureParty(Vector3d::UnitZ(), buildings);
  EXPECT_NEAR(buildings[0].facets[0].party, 15.0 / 60, 1e-9);
  EXPECT_EQ(buildings[0].facets[1].party, 0);
  EXPECT_NEAR(buildings[0].facets[2].party, 1, 1e-9);
}

TEST(PartyWalls, TheFloorOfASolidIsHiddenAndNoUnderside) {
  Building gate{.id = "B0001", .watertight = true, .source = "map", .detail = "full", .facets = {}};
  gate.facets.push_back(
      FacetOf(FacetClass::kGround, {{0, 0, 0}, {0, 8, 0}, {4, 8, 0.2}, {4, 0, 0.2}}));
  gate.facets.push_back(FacetOf(FacetClass::kGround, {{4, 0, 4}, {4, 8, 4}, {8, 8, 4}, {8, 0, 4}}));
  gate.facets.push_back(FacetOf(FacetClass::kRoof, {{0, 0, 9}, {8, 0, 9}, {8, 8, 9}, {0, 8, 9}}));
  Building ground{.id = "G0", .watertight = false, .source = "cloud", .detail = {}, .facets = {}};
  ground.facets.push_back(
      FacetOf(FacetClass::kGround, {{-9, -9, 0}, {19, -9, 0}, {19, 19, 0}, {-9, 19, 0}}));
  std::vector<Building> buildings = {gate, ground};
  MeasureParty(Vector3d::UnitZ(), buildings);
  EXPECT_EQ(buildings[0].facets[0].party, 1);
  EXPECT_EQ(buildings[0].facets[1].party, 0);
  EXPECT_EQ(buildings[0].facets[2].party, 0);
  EXPECT_EQ(buildings[1].facets[0].party, 0);
}

}  // namespace
}  // namespace stucco
