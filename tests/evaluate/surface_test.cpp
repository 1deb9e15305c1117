// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/surface.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <tuple>

#include "evaluate/geometry/part_near.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/geometry/surface_index.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

Surface BoxSurface() {
  Surface surface;
  for (const Facet& facet : MadeBox("B", {0, 0, 0}, {10, 8, 6}).facets) Append(facet, surface);
  return surface;
}

TEST(Surface, HasTheAreaOfItsFacets) {
  EXPECT_NEAR(SurfaceArea(BoxSurface()), 2 * (80 + 60 + 48), 1e-9);
  Surface twice = BoxSurface();
  Append(BoxSurface(), twice);
  EXPECT_NEAR(SurfaceArea(twice), 4 * (80 + 60 + 48), 1e-9);
}

TEST(Surface, KnowsThePartsOfASceneByTheirNames) {
  EXPECT_EQ(GroupOf("G0"), static_cast<int>(FacetClass::kGround));
  EXPECT_EQ(GroupOf("B0001/F03"), static_cast<int>(FacetClass::kWall));
  EXPECT_EQ(GroupOf("B0001/W03"), static_cast<int>(FacetClass::kWall));
  EXPECT_EQ(GroupOf("B0001/R2"), static_cast<int>(FacetClass::kRoof));
  EXPECT_EQ(GroupOf("B0001/trim"), static_cast<int>(FacetClass::kOuterFloor));
  EXPECT_EQ(GroupOf("occluder/tree-001"), kStandsAbout);
}

TEST(Surface, OfASceneIsItsReliefAndWhatStandsAbout) {
  const simulate::Scene scene = MadeScene(MadeTruth());
  const Surface all = SurfaceOf(scene);
  const Surface relief = ReliefOf(scene);
  EXPECT_NEAR(SurfaceArea(all) - SurfaceArea(relief), 2 * (4 + 8 + 8), 1e-3);  // the tree
  EXPECT_EQ(std::count(all.groups.begin(), all.groups.end(), kStandsAbout), 12);
  EXPECT_EQ(std::count(relief.groups.begin(), relief.groups.end(), kStandsAbout), 0);
}

TEST(PartNear, CutsLargeTrianglesAtTheBorder) {
  Surface field;  // 800 x 800 m of ground
  field.vertices = {{-400, -400, 0}, {400, -400, 0}, {400, 400, 0}, {-400, 400, 0}};
  field.triangles = {{0, 1, 2}, {0, 2, 3}};
  field.groups = {2, 2};
  const SurfaceIndex box(BoxSurface());  // 10 x 8 m at the origin
  const Surface near = PartNear(field, box, 15);
  // The rectangle, grown by 15 m with round corners.
  const double area = 10 * 8 + 15 * 2 * (10 + 8) + std::numbers::pi * 15 * 15;
  EXPECT_NEAR(SurfaceArea(near), area, 0.005 * area);
  for (const Vector3d& vertex : near.vertices) EXPECT_LT(box.Distance(vertex), 15.3);
  EXPECT_EQ(near.groups, std::vector<int>(near.triangles.size(), 2));
  EXPECT_NEAR(SurfaceArea(PartNear(BoxSurface(), box, 15)), SurfaceArea(BoxSurface()), 1e-9);
  EXPECT_TRUE(PartNear(field, SurfaceIndex(Surface()), 15).triangles.empty());
}

TEST(SamplePoints, AreSpreadByArea) {
  const auto points = SamplePoints(BoxSurface(), 37600, 1);
  ASSERT_EQ(points.size(), 37600u);
  int walls = 0;
  Vector3d sum = Vector3d::Zero();
  for (const SurfacePoint& point : points) {
    walls += point.group == static_cast<int>(FacetClass::kWall);
    sum += point.position;
  }
  EXPECT_NEAR(walls, 21600, 2);  // at most one part of equal area lies across each border
  // Standard deviation of the mean below 6 / sqrt(12 * 37600), far less by the even parts.
  EXPECT_NEAR((sum / 37600 - Vector3d(5, 4, 3)).norm(), 0, 0.02);
  EXPECT_EQ(points[9].position, SamplePoints(BoxSurface(), 37600, 1)[9].position);
  EXPECT_NE(points[9].position, SamplePoints(BoxSurface(), 37600, 2)[9].position);
}

TEST(SamplePoints, FillATriangleEvenly) {
  Surface triangle;
  triangle.vertices = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
  triangle.triangles = {{0, 1, 2}};
  triangle.groups = {7};
  int near_a_corner = 0;
  for (const SurfacePoint& point : SamplePoints(triangle, 10000, 3)) {
    EXPECT_GE(point.position.minCoeff(), 0);
    EXPECT_LE(point.position.sum(), 1 + 1e-12);
    EXPECT_EQ(point.group, 7);
    EXPECT_EQ(point.normal, Vector3d::UnitZ());
    near_a_corner += point.position.x() > 0.5;
  }
  EXPECT_NEAR(near_a_corner, 2500, 5 * 44);  // five standard deviations
}

TEST(SamplePoints, NothingHasNone) {
  EXPECT_TRUE(SamplePoints({}, 100, 1).empty());
  Surface needle;
  needle.vertices = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}};
  needle.triangles = {{0, 1, 2}};
  needle.groups = {0};
  EXPECT_TRUE(SamplePoints(needle, 100, 1).empty());
}

TEST(SurfaceIndex, DistancesAreExact) {
  const SurfaceIndex box(BoxSurface());
  EXPECT_NEAR(box.Distance({5, 4, 7.5}), 1.5, 1e-12);
  EXPECT_NEAR(box.Distance({5, 4, 5}), 1, 1e-12);     // inside
  EXPECT_NEAR(box.Distance({13, 12, 3}), 5, 1e-12);   // an edge
  EXPECT_NEAR(box.Distance({-2, -3, 12}), 7, 1e-12);  // a corner
  EXPECT_NEAR(box.Distance({1.0 / 3, 0, 1.0 / 7}), 0, 1e-12);
  EXPECT_EQ(SurfaceIndex(Surface()).Distance({1, 2, 3}), std::numeric_limits<double>::infinity());
}

TEST(SurfaceIndex, AgreesWithTryingEveryTriangleFarFromTheOrigin) {
  Surface far = BoxSurface();
  for (Vector3d& vertex : far.vertices) vertex += Vector3d(713.123456789, -955.3, 41.7);
  const SurfaceIndex index(far);
  std::vector<SurfaceIndex> single;
  for (const auto& triangle : far.triangles) {
    Surface one;
    one.vertices = far.vertices;
    one.triangles = {triangle};
    one.groups = {0};
    single.emplace_back(std::move(one));
  }
  std::vector<Vector3d> points;
  for (int i = 0; i < 200; ++i) {
    points.push_back(far.vertices[0] +
                     Vector3d(9 * std::sin(i), 9 * std::sin(2.3 * i), 9 * std::sin(3.7 * i)));
  }
  const std::vector<double> distances = Distances(points, index, 2);
  for (size_t i = 0; i < points.size(); ++i) {
    double least = std::numeric_limits<double>::infinity();
    for (const SurfaceIndex& one : single) least = std::min(least, one.Distance(points[i]));
    EXPECT_EQ(distances[i], least);
  }
}

TEST(SurfaceIndex, KnowsWhatIsInTheWay) {
  const SurfaceIndex box(BoxSurface());
  EXPECT_TRUE(box.Blocked({-5, 4, 3}, {15, 4, 3}));
  EXPECT_FALSE(box.Blocked({-5, 4, 7}, {15, 4, 7}));
  EXPECT_FALSE(box.Blocked({-5, 4, 3}, {-1, 4, 3}));  // ends before it
  EXPECT_FALSE(SurfaceIndex(Surface()).Blocked({-5, 4, 3}, {15, 4, 3}));
}

TEST(PhotosThatShow, WhatPhotosShow) {
  const Proxy truth = MadeTruth();
  const simulate::Flight flight = MadeFlight();
  const SurfaceIndex scene(SurfaceOf(MadeScene(truth)));
  const std::vector<SurfacePoint> points = {
      {{5, 8, 3}, Vector3d::UnitY(), 0},       // a free wall
      {{5, 8, 3}, -Vector3d::UnitY(), 0},      // its inside
      {{5, 4, 0}, -Vector3d::UnitZ(), 0},      // an underside
      {{5, 4, 6}, Vector3d::UnitZ(), 0},       // a roof
      {{5, -4, 0}, Vector3d::UnitZ(), 0},      // below the tree
      {{300, 300, 0}, Vector3d::UnitZ(), 0}};  // in no picture
  const auto photos = DeliveredPhotos(flight);
  EXPECT_EQ(PhotosThatShow(points, photos, scene, 1, 1), (std::vector<char>{1, 0, 0, 1, 0, 0}));
  EXPECT_EQ(PhotosThatShow(points, {}, scene, 1, 1), std::vector<char>(6, 0));
}

TEST(PhotosThatShow, EachPhotoCountsOnceUpToEnough) {
  const SurfaceIndex scene(SurfaceOf(MadeScene(MadeTruth())));
  const simulate::Flight flight = MadeFlight();
  const simulate::FlownPhoto* photo = DeliveredPhotos(flight).front();
  std::vector<SurfacePoint> points;
  for (int x = 1; x < 10; ++x) points.push_back({{1.0 * x, 4, 6}, Vector3d::UnitZ(), 0});
  const std::vector<char> by_one = PhotosThatShow(points, std::vector{photo}, scene, 9, 1);
  EXPECT_GT(std::ranges::count(by_one, 1), 0);
  for (const auto& [photos, enough, expected] :
       {std::tuple(2, 9, 2), std::tuple(4, 3, 3), std::tuple(3, 3, 3)}) {
    const std::vector<const simulate::FlownPhoto*> copies(photos, photo);
    const std::vector<char> showing =
        PhotosThatShow(points, copies, scene, static_cast<char>(enough), 1);
    for (size_t i = 0; i < points.size(); ++i) EXPECT_EQ(showing[i], by_one[i] * expected);
  }
}

TEST(PhotosThatShow, LostAndHeldOutPhotosShowNothing) {
  simulate::Flight flight = MadeFlight();
  for (simulate::FlownPhoto& photo : flight.photos) photo.lost = true;
  flight.photos[0].lost = false;
  flight.photos[0].held_out = true;
  EXPECT_TRUE(DeliveredPhotos(flight).empty());
}

}  // namespace
}  // namespace stucco::evaluate
