// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/regularise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "proxy/scene/clusters.h"
#include "proxy/scene/ground.h"

namespace stucco {
namespace {

using Eigen::Vector3d;

constexpr double kDegree = std::numbers::pi / 180;

double AngleDeg(const Vector3d& a, const Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b)) / kDegree;
}

struct Planes {
  Samples samples;
  std::vector<Plane> planes;
  Tolerances tolerances{.level_of_detail = 0.3,
                        .epsilon = 0.15,
                        .min_area = 2.25,
                        .fill_gap = 1.5,
                        .spacing = 0.1,
                        .radius = 0.3};

  // A rectangle of points around `center`, `width` along the horizontal and `height` across it.
  void Add(const Vector3d& center, const Vector3d& normal, double width, double height) {
    Plane plane;
    plane.normal = normal.normalized();
    plane.offset = plane.normal.dot(center);
    Vector3d u = Vector3d::UnitZ().cross(plane.normal);
    u = u.norm() < 0.02 ? Vector3d::UnitX() : Vector3d(u.normalized());
    const Vector3d v = plane.normal.cross(u);
    for (double a = -width / 2 + 0.05; a < width / 2; a += 0.1) {
      for (double b = -height / 2 + 0.05; b < height / 2; b += 0.1) {
        plane.points.push_back(static_cast<int>(samples.size()));
        samples.positions.push_back(center + a * u + b * v);
        samples.normals.push_back(plane.normal);
        samples.weights.push_back(1);
        samples.cameras.push_back(-1);
      }
    }
    Measure(samples, 0.25, plane);
    planes.push_back(std::move(plane));
  }
  void Run() { Regularise(samples, tolerances, Vector3d::UnitZ(), {}, planes); }
};

Vector3d Leaning(double azimuth_deg, double elevation_deg) {
  const double a = azimuth_deg * kDegree, e = elevation_deg * kDegree;
  return {std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e)};
}

TEST(Regularise, MakesWallsVerticalAndPerpendicular) {
  Planes p;
  p.Add({0, -5, 3}, Leaning(-90, 1.5), 10, 6);
  p.Add({5, 0, 3}, Leaning(1.2, -1), 6, 6);
  p.Add({-5, 0, 3}, Leaning(179, 0.5), 5, 6);
  p.Run();
  ASSERT_EQ(p.planes.size(), 3u);
  for (const Plane& plane : p.planes) {
    EXPECT_EQ(plane.role, PlaneRole::kWall);
    EXPECT_NEAR(plane.normal.z(), 0, 1e-12);
    EXPECT_NEAR(plane.normal.norm(), 1, 1e-12);
  }
  EXPECT_NEAR(AngleDeg(p.planes[0].normal, p.planes[1].normal), 90, 1e-9);
  EXPECT_NEAR(AngleDeg(p.planes[1].normal, p.planes[2].normal), 180, 1e-9);
}

TEST(Regularise, KeepsTheLeanOfATallWall) {
  for (const double lean_deg : {6.0, -6.0, -20.0}) {
    Planes p;
    p.Add({0, -5, 6}, Leaning(-90, lean_deg), 14, 12);  // upright, its rim would move by 0.6 m
    const size_t points = p.planes[0].points.size();
    p.Run();
    ASSERT_EQ(p.planes.size(), 1u) << lean_deg;
    EXPECT_EQ(p.planes[0].role, PlaneRole::kWall) << lean_deg;
    EXPECT_NEAR(AngleDeg(p.planes[0].normal, Leaning(-90, lean_deg)), 0, 0.01) << lean_deg;
    EXPECT_EQ(p.planes[0].points.size(), points) << lean_deg;
  }
}

TEST(Regularise, ALowFrontThatLeansOutStandsUpright) {
  Planes p;
  p.Add({0, -5, 6}, Leaning(-90, -15), 3, 1);
  p.Run();
  ASSERT_EQ(p.planes.size(), 1u);
  EXPECT_NEAR(p.planes[0].normal.z(), 0, 1e-12);
}

TEST(Regularise, LeavesALongWallOfItsOwnDirectionAlone) {
  Planes p;
  p.Add({0, -5, 3}, Leaning(-90, 0), 20, 6);
  p.Add({0, 15, 3}, Leaning(85, 0), 20, 6);  // turning it by 5 degrees would move its ends 0.87 m
  p.Run();
  ASSERT_EQ(p.planes.size(), 2u);
  EXPECT_NEAR(AngleDeg(p.planes[0].normal, p.planes[1].normal), 175, 0.6);
}

TEST(Regularise, MakesFlatRoofsFlatAndPitchesEqual) {
  Planes p;
  p.Add({0, 0, 9}, Vector3d(0.01, 0.005, 1), 6, 6);
  p.Add({0, -4, 5}, Leaning(-90, 44), 8, 3);
  p.Add({0, 4, 5}, Leaning(90.5, 45.5), 8, 3);
  p.Add({0, -6, 2}, Leaning(-90, 0), 8, 4);
  p.Run();
  int slopes = 0;
  for (const Plane& plane : p.planes) {
    if (plane.role == PlaneRole::kHorizontal) {
      EXPECT_EQ(plane.normal, Vector3d::UnitZ());
    }
    if (plane.role != PlaneRole::kSlope) continue;
    ++slopes;
    EXPECT_NEAR(std::asin(plane.normal.z()) / kDegree, 44.75, 0.1);
  }
  EXPECT_EQ(slopes, 2);
}

TEST(Regularise, JoinsParallelPlanesCloserThanTheLevelOfDetail) {
  Planes p;
  p.Add({-3, 0, 2}, Leaning(-90, 0), 4, 4);
  p.Add({3, 0.2, 2}, Leaning(-90, 0), 3.8, 4);
  p.Add({9, 0.7, 2}, Leaning(-90, 0), 3.6, 4);
  p.Run();
  ASSERT_EQ(p.planes.size(), 2u);
  EXPECT_NEAR(p.planes[0].offset, -0.1, 0.02);
  EXPECT_NEAR(p.planes[1].offset, -0.7, 1e-9);
}

TEST(Regularise, NothingIsNothing) {
  Planes p;
  p.Run();
  EXPECT_TRUE(p.planes.empty());
}

TEST(FindGround, TakesTheLowFloorAndNotTheRoof) {
  Planes p;
  p.Add({0, 0, 8}, Vector3d::UnitZ(), 20, 20);
  p.Add({20, 0, 0}, Vector3d::UnitZ(), 12, 12);
  p.Add({-20, 0, 0.4}, Vector3d::UnitZ(), 8, 8);
  p.Add({0, -10, 4}, -Vector3d::UnitY(), 20, 8);
  const auto ground = FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), p.planes);
  EXPECT_EQ(ground, (std::vector<int>{1, 2}));
}

TEST(FindGround, KnowsThatThereIsNone) {
  Planes p;
  p.Add({0, 0, 8}, Vector3d::UnitZ(), 20, 20);
  p.Add({0, -10, 4}, -Vector3d::UnitY(), 20, 8);
  EXPECT_TRUE(FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), p.planes).empty());
  EXPECT_TRUE(FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), {}).empty());
}

// A sloping site 120 m long with houses of 8 m on it, ten degrees down to the south.
Planes HillSite() {
  constexpr double kSlope = 0.1763;
  Planes p;
  p.Add({0, 0, 0}, Leaning(-90, 80), 40, 120 / std::cos(10 * kDegree));
  for (const double y : {-45.0, 0.0, 45.0}) {
    const double foot = kSlope * y, eaves = foot + 8;
    p.Add({0, y, eaves}, Vector3d::UnitZ(), 12, 10);
    for (const double side : {-1.0, 1.0}) {
      p.Add({0, y + 5 * side, (foot + 5 * side * kSlope + eaves) / 2}, side * Vector3d::UnitY(), 12,
            8 - 5 * side * kSlope);
      p.Add({6 * side, y, foot + 4}, side * Vector3d::UnitX(), 10, 8);
    }
  }
  return p;
}

TEST(FindGround, TakesASlopeAndNoneOfTheRoofsOnIt) {
  const Planes p = HillSite();
  EXPECT_EQ(FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), p.planes),
            (std::vector<int>{0}));
}

TEST(FindGround, FollowsTerrainThatRollsUpAndDown) {
  Planes p;
  double x = 0, z = 0;
  for (const double pitch_deg : {0.0, 8.0, 14.0, 6.0, -5.0, -12.0}) {
    const double run = 15 * std::cos(pitch_deg * kDegree),
                 rise = 15 * std::sin(pitch_deg * kDegree);
    p.Add({x + run / 2, 0, z + rise / 2}, Leaning(180, 90 - pitch_deg), 30, 15);
    x += run;
    z += rise;
  }
  const size_t pieces = p.planes.size();
  p.Add({20, 0, 9}, Vector3d::UnitZ(), 8, 8);  // a roof as high as the hill
  p.Add({20, -4, 5}, -Vector3d::UnitY(), 8, 8);
  p.Add({24, 0, 5}, Vector3d::UnitX(), 8, 8);
  auto ground = FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), p.planes);
  std::sort(ground.begin(), ground.end());
  ASSERT_EQ(ground.size(), pieces);
  for (size_t i = 0; i < pieces; ++i) EXPECT_EQ(ground[i], static_cast<int>(i));
}

TEST(FindGround, AYardBetweenHousesIsGroundAndASunkenRoofIsNot) {
  Planes p;
  p.Add({0, -40, 0}, Vector3d::UnitZ(), 60, 20);
  p.Add({0, 0, 0.5}, Vector3d::UnitZ(), 10, 10);
  p.Add({30, 0, 6}, Vector3d::UnitZ(), 10, 10);
  for (const double x : {0.0, 30.0}) {  // higher wings around both
    for (const double side : {-1.0, 1.0}) {
      p.Add({x + 8 * side, 0, 12}, Vector3d::UnitZ(), 6, 22);
      p.Add({x, 8 * side, 12}, Vector3d::UnitZ(), 10, 6);
    }
  }
  EXPECT_EQ(FindGround(p.samples, p.tolerances, Vector3d::UnitZ(), p.planes),
            (std::vector<int>{0, 1}));
}

TEST(GroundBelow, IsThePlaneAroundTheBuilding) {
  Planes p;
  p.Add({0, 0, 0}, Vector3d::UnitZ(), 30, 30);
  p.Add({40, 0, 6}, Leaning(180, 80), 30, 30);
  p.Add({40, 0, 14}, Vector3d::UnitZ(), 10, 10);
  const std::vector<Plane> roof = {p.planes[2]};
  p.planes.pop_back();
  const Vector3d up = Vector3d::UnitZ();
  EXPECT_EQ(GroundBelow(p.samples, up, p.planes, roof), &p.planes[1]);
  EXPECT_EQ(GroundBelow(p.samples, up, {}, roof), nullptr);
  EXPECT_EQ(GroundBelow(p.samples, up, p.planes, {}), &p.planes[0]);
}

TEST(FitFloor, FindsGroundSeenInPatches) {
  Planes p;
  p.Add({0, -10, 4}, -Vector3d::UnitY(), 20, 8);
  for (int i = 0; i < 12; ++i) {
    p.Add({-20.0 + 4 * i, -20.0 + (i % 3), 0.01 * i}, Vector3d::UnitZ(), 1.6, 1.6);
  }
  p.Add({0, 0, 8}, Vector3d::UnitZ(), 20, 20);
  const auto floor = FitFloor(p.samples, p.tolerances, Vector3d::UnitZ());
  ASSERT_TRUE(floor);
  EXPECT_LT(AngleDeg(floor->normal, Vector3d::UnitZ()), 0.5);
  EXPECT_NEAR(floor->offset, 0.05, 0.1);
  EXPECT_EQ(floor->points.size(), 12u * 16 * 16);
}

TEST(FitFloor, AFewPatchesAreNoGround) {
  Planes p;
  p.Add({0, -10, 4}, -Vector3d::UnitY(), 20, 8);
  p.Add({3, -15, 0}, Vector3d::UnitZ(), 1.6, 1.6);
  EXPECT_FALSE(FitFloor(p.samples, p.tolerances, Vector3d::UnitZ()));
  EXPECT_FALSE(FitFloor({}, p.tolerances, Vector3d::UnitZ()));
}

TEST(SplitIntoBuildings, SplitsWhatStandsApartAndDropsCars) {
  Planes p;
  p.Add({0, 0, 3}, -Vector3d::UnitY(), 10, 6);
  p.Add({5, 3, 3}, Vector3d::UnitX(), 6, 6);
  p.Add({30, 0, 3}, -Vector3d::UnitY(), 8, 6);
  p.Add({15, -8, 0.7}, -Vector3d::UnitY(), 4.5, 1.4);
  const Clusters clusters =
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), {}, p.planes);
  ASSERT_EQ(clusters.buildings.size(), 2u);
  EXPECT_EQ(clusters.buildings[0].size(), 2u);
  EXPECT_EQ(clusters.buildings[1].size(), 1u);
  EXPECT_EQ(clusters.dropped, 1);
}

TEST(SplitIntoBuildings, AFewLeavesMakeNoHouseOfAHedge) {
  Planes p;
  p.Add({0, 0, 0.7}, -Vector3d::UnitY(), 14, 1.4);
  p.Add({0, 1.2, 0.7}, Vector3d::UnitY(), 14, 1.4);
  p.Add({2, 0, 1.8}, -Vector3d::UnitY(), 0.2, 0.9);  // a twig in the plane of its front
  std::vector<int>& front = p.planes[0].points;
  front.insert(front.end(), p.planes[2].points.begin(), p.planes[2].points.end());
  p.planes.pop_back();
  const std::vector<Plane> ground(1);
  const Clusters clusters =
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), ground, p.planes);
  EXPECT_TRUE(clusters.buildings.empty());
  EXPECT_EQ(clusters.dropped, 1);
}

TEST(SplitIntoBuildings, KeepsAHouseBesideAHall) {
  Planes p;
  p.Add({0, 0, 12}, Vector3d::UnitZ(), 90, 75);
  p.Add({60, 0, 2.5}, -Vector3d::UnitY(), 6, 5);  // less than one part in a hundred of the hall
  p.Add({63, 3, 2.5}, Vector3d::UnitX(), 6, 5);
  const std::vector<Plane> ground(1);
  const Clusters clusters =
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), ground, p.planes);
  EXPECT_EQ(clusters.buildings.size(), 2u);
  EXPECT_EQ(clusters.dropped, 0);
}

TEST(SplitIntoBuildings, KeepsAHouseThatFewPointsShow) {
  Planes p;
  p.Add({0, 0, 3.5}, -Vector3d::UnitY(), 10, 7);
  p.Add({5, 4, 3.5}, Vector3d::UnitX(), 8, 7);
  p.Add({0, 4, 7}, Vector3d::UnitZ(), 10, 8);
  p.tolerances.level_of_detail = 1.2;
  p.tolerances.min_area = 18;
  p.tolerances.coarseness = 4;
  EXPECT_EQ(
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), {}, p.planes).buildings.size(),
      1u);
}

TEST(SplitIntoBuildings, SplitsAWallPlaneThatTwoHousesShare) {
  Planes p;
  p.Add({0, 0, 3}, -Vector3d::UnitY(), 10, 6);
  p.Add({30, 0, 3}, -Vector3d::UnitY(), 8, 6);
  Plane joined = p.planes[0];
  joined.points.insert(joined.points.end(), p.planes[1].points.begin(), p.planes[1].points.end());
  const Clusters clusters =
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), {}, {joined});
  ASSERT_EQ(clusters.buildings.size(), 2u);
  EXPECT_EQ(clusters.buildings[0][0].points, p.planes[0].points);
}

TEST(SplitIntoBuildings, KeepsALoneRoofHighAboveTheGround) {
  Planes p;
  p.Add({0, 0, 6}, Vector3d::UnitZ(), 10, 8);
  const std::vector<Plane> ground(1);
  EXPECT_TRUE(SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), {}, p.planes)
                  .buildings.empty());
  EXPECT_EQ(SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), ground, p.planes)
                .buildings.size(),
            1u);
}

}  // namespace
}  // namespace stucco
