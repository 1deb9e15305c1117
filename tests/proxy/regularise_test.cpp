// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/regularise.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "proxy/clusters.h"
#include "proxy/ground.h"

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
        samples.stations.push_back(-1);
      }
    }
    Measure(samples, 0.25, plane);
    planes.push_back(std::move(plane));
  }
  Vector3d Run() { return Regularise(samples, tolerances, Vector3d::UnitZ(), {}, planes); }
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
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), nullptr, p.planes);
  ASSERT_EQ(clusters.buildings.size(), 2u);
  EXPECT_EQ(clusters.buildings[0].size(), 2u);
  EXPECT_EQ(clusters.buildings[1].size(), 1u);
  EXPECT_EQ(clusters.dropped, 1);
}

TEST(SplitIntoBuildings, SplitsAWallPlaneThatTwoHousesShare) {
  Planes p;
  p.Add({0, 0, 3}, -Vector3d::UnitY(), 10, 6);
  p.Add({30, 0, 3}, -Vector3d::UnitY(), 8, 6);
  Plane joined = p.planes[0];
  joined.points.insert(joined.points.end(), p.planes[1].points.begin(), p.planes[1].points.end());
  const Clusters clusters =
      SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), nullptr, {joined});
  ASSERT_EQ(clusters.buildings.size(), 2u);
  EXPECT_EQ(clusters.buildings[0][0].points, p.planes[0].points);
}

TEST(SplitIntoBuildings, KeepsALoneRoofHighAboveTheGround) {
  Planes p;
  p.Add({0, 0, 6}, Vector3d::UnitZ(), 10, 8);
  Plane ground;
  EXPECT_TRUE(SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), nullptr, p.planes)
                  .buildings.empty());
  EXPECT_EQ(SplitIntoBuildings(p.samples, p.tolerances, Vector3d::UnitZ(), &ground, p.planes)
                .buildings.size(),
            1u);
}

}  // namespace
}  // namespace stucco
