// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/cloud.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>

#include "evaluate/geometry/compare_proxy.h"
#include "evaluate/geometry/seen.h"
#include "survey/error.h"
#include "survey/point_cloud.h"
#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Vector3d;

// The walls and roofs of both houses: 648 m2, 296 m2 of them the first one's.
class Clouds : public ::testing::Test {
 protected:
  void SetUp() override {
    truth_.points = SamplePoints(houses_.surface(), 20000, 5);
    truth_.showing.assign(truth_.points.size(), kPhotosToConfirm);
  }

  // Points of the houses, `away` metres along the normal of the surface.
  static PointCloud CloudOf(double away, size_t count = 300000) {
    PointCloud cloud;
    for (const SurfacePoint& point : SamplePoints(BuildingSurface(MadeTruth()), count, 2)) {
      cloud.positions.push_back(point.position + away * point.normal);
    }
    return cloud;
  }
  SurfaceFigures Compare(const PointCloud& cloud, double tolerance_m,
                         const Similarity& frame = {}) {
    return CompareParts(cloud, tolerance_m, frame).all;
  }
  PartFigures CompareParts(PointCloud cloud, double tolerance_m, const Similarity& frame) {
    for (Vector3d& position : cloud.positions) position = frame.Inverse() * position;
    const auto path = std::filesystem::path(::testing::TempDir()) / "evaluate_cloud.ply";
    WritePly(cloud, path);
    return CompareCloud(path, frame, scene_, truth_, {tolerance_m, 2});
  }

  SurfaceIndex houses_{BuildingSurface(MadeTruth())};
  SceneIndex scene_{SurfaceIndex(BuildingSurface(MadeTruth())),
                    SurfaceIndex(BuildingSurface(MadeTruth()))};
  TruthPoints truth_;
};

TEST_F(Clouds, TruthHasNoErrorAndIsComplete) {
  const SurfaceFigures figures = Compare(CloudOf(0), 0.2);
  EXPECT_NEAR(figures.error95_m, 0, 1e-12);
  EXPECT_EQ(figures.completeness, 1);
  EXPECT_EQ(figures.completeness_all, 1);
}

TEST_F(Clouds, AnotherFrameChangesNothing) {
  const SurfaceFigures figures = Compare(CloudOf(0), 0.2, AnySimilarity());
  EXPECT_NEAR(figures.error95_m, 0, 1e-9);
  EXPECT_EQ(figures.completeness, 1);
}

TEST_F(Clouds, AKnownDistanceIsFound) {
  EXPECT_NEAR(Compare(CloudOf(0.07), 0.2).error95_m, 0.07, 1e-9);
  EXPECT_EQ(Compare(CloudOf(0.3), 0.25).completeness, 0);
}

TEST_F(Clouds, TheErrorIsThatOfTheWorstTwentieth) {
  PointCloud cloud = CloudOf(0);
  for (size_t i = 0; i < cloud.size(); ++i) {
    cloud.positions[i].z() += i % 100 < 6 ? 1000 : 0;
  }
  EXPECT_NEAR(Compare(cloud, 0.2).error95_m, 1000, 10);
  cloud = CloudOf(0);
  for (size_t i = 0; i < cloud.size(); ++i) {
    cloud.positions[i].z() += i % 100 < 4 ? 1000 : 0;
  }
  EXPECT_NEAR(Compare(cloud, 0.2).error95_m, 0, 1e-9);
}

TEST_F(Clouds, NoiseHasItsQuantile) {
  PointCloud cloud;
  size_t i = 0;
  // Even from -0.1 to 0.1 along the normal: 95 % are below 0.095, but for what is nearer around
  // edges.
  for (const SurfacePoint& point : SamplePoints(BuildingSurface(MadeTruth()), 100000, 2)) {
    const double share = std::fmod(static_cast<double>(i++) * 0.6180339887498949, 1.0);
    cloud.positions.push_back(point.position + (0.2 * share - 0.1) * point.normal);
  }
  EXPECT_NEAR(Compare(cloud, 0.2).error95_m, 0.095, 0.001);
}

TEST_F(Clouds, WhatIsMissingIsMissingFromCompleteness) {
  PointCloud cloud = CloudOf(0);
  std::erase_if(cloud.positions, [](const Vector3d& position) { return position.x() > 15; });
  EXPECT_NEAR(Compare(cloud, 0.2).completeness, 296.0 / 648, 1e-3);
  for (size_t i = 0; i < truth_.points.size(); ++i) {
    truth_.showing[i] = truth_.points[i].position.x() < 15 ? 1 : 0;
  }
  const SurfaceFigures figures = Compare(cloud, 0.2);
  EXPECT_EQ(figures.completeness, 1);
  EXPECT_TRUE(std::isnan(figures.completeness_of_three));
  EXPECT_NEAR(figures.completeness_all, 296.0 / 648, 1e-3);
}

TEST_F(Clouds, WhatThreePhotosShowIsAskedApart) {
  PointCloud cloud = CloudOf(0);
  std::erase_if(cloud.positions, [](const Vector3d& position) { return position.x() > 15; });
  for (size_t i = 0; i < truth_.points.size(); ++i) {
    truth_.showing[i] = truth_.points[i].position.x() < 15 ? kPhotosToConfirm : 2;
  }
  const SurfaceFigures figures = Compare(cloud, 0.2);
  EXPECT_NEAR(figures.completeness, 296.0 / 648, 1e-3);
  EXPECT_EQ(figures.completeness_of_three, 1);
}

TEST_F(Clouds, EveryPartHasFiguresOfItsOwn) {
  PointCloud cloud;
  for (const SurfacePoint& point : SamplePoints(BuildingSurface(MadeTruth()), 300000, 2)) {
    const bool is_roof = point.group == static_cast<int>(FacetClass::kRoof);
    cloud.positions.push_back(point.position + (is_roof ? 0.3 : 0.05) * point.normal);
  }
  const PartFigures figures = CompareParts(cloud, 0.2, {});
  EXPECT_NEAR(figures.wall.error95_m, 0.05, 1e-6);
  EXPECT_NEAR(figures.roof.error95_m, 0.3, 1e-6);
  EXPECT_EQ(figures.wall.completeness, 1);
  EXPECT_LT(figures.roof.completeness, 0.1);  // rims, which walls are near
  EXPECT_TRUE(std::isnan(figures.ground.error95_m));
}

// Fields lie far around a survey, and most of a cloud is of them: here more than 95 %.
TEST_F(Clouds, FieldsFarFromBuildingsNeitherFlatterNorHurt) {
  Surface ground;
  ground.vertices = {{-400, -400, 0}, {400, -400, 0}, {400, 400, 0}, {-400, 400, 0}};
  ground.triangles = {{0, 1, 2}, {0, 2, 3}};
  ground.groups.assign(2, static_cast<int>(FacetClass::kGround));
  Surface everything = BuildingSurface(MadeTruth());
  Append(ground, everything);
  scene_.everything = SurfaceIndex(everything);
  PointCloud cloud = CloudOf(1, 20000);
  const size_t num_of_houses = cloud.size();
  for (const SurfacePoint& point : SamplePoints(ground, 600000, 3)) {
    if (houses_.Distance(point.position) > kGroundReachM) cloud.positions.push_back(point.position);
  }
  ASSERT_GT(cloud.size(), 20 * num_of_houses);
  EXPECT_NEAR(Compare(cloud, 0.2).error95_m, 1, 1e-6);
  // Below, where no house is nearer than the ground.
  for (size_t i = num_of_houses; i < cloud.size(); ++i) cloud.positions[i].z() = -50;
  EXPECT_NEAR(Compare(cloud, 0.2).error95_m, 1, 1e-6);
}

TEST_F(Clouds, AnEmptyCloudHasNoErrorAndNothing) {
  const SurfaceFigures figures = Compare({}, 0.2);
  EXPECT_TRUE(std::isnan(figures.error95_m));
  EXPECT_EQ(figures.completeness, 0);
}

TEST_F(Clouds, ADamagedFileIsAnError) {
  EXPECT_THROW(CompareCloud("/nowhere/cloud.ply", {}, scene_, truth_, {0.1, 1}), Error);
}

TEST_F(Clouds, ASurfaceIsMeasuredTheSameWay) {
  SurfaceFigures figures = CompareSurface(houses_, scene_, truth_, {0.1, 2}).all;
  EXPECT_NEAR(figures.error95_m, 0, 1e-12);
  EXPECT_EQ(figures.completeness, 1);
  Surface lifted = houses_.surface();
  for (Vector3d& vertex : lifted.vertices) vertex.z() += 0.3;
  figures = CompareSurface(SurfaceIndex(lifted), scene_, truth_, {0.1, 2}).all;
  EXPECT_NEAR(figures.error95_m, 0.3, 1e-9);  // the roofs; walls slide in themselves
  // Walls but for their lowest 0.2 m, no roof but a rim of 0.1 m, which the walls now cross.
  const double rims = (80 - 9.8 * 7.8) + (64 - 7.8 * 7.8);
  EXPECT_NEAR(figures.completeness, (36 * 5.8 + 32 * 8.8 + rims) / 648, 3e-3);
}

}  // namespace
}  // namespace stucco::evaluate
