// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <limits>
#include <random>

#include "proxy/cloud/blocks.h"
#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/scale.h"

namespace stucco {
namespace {

PointCloud Grid(int side, double step) {
  PointCloud cloud;
  for (int x = 0; x < side; ++x) {
    for (int y = 0; y < side; ++y) {
      cloud.positions.emplace_back(x * step, y * step, 1.0);
      cloud.normals.emplace_back(0.F, 0.F, 1.F);
      cloud.views.push_back({7});
    }
  }
  return cloud;
}

std::vector<SurveyPhoto> OnePhoto() {
  std::vector<SurveyPhoto> photos(1);
  photos[0].id = {7};
  photos[0].cam_from_world.translation = {0, 0, -11};
  return photos;
}

TEST(ThinCloud, KeepsSmallCloudsAsTheyAre) {
  const PointCloud cloud = Grid(20, 0.1);
  const Samples samples = ThinCloud(StreamOf(cloud), OnePhoto(), 1000, 0);
  ASSERT_EQ(samples.size(), 400u);
  EXPECT_EQ(samples.cell, 0);
  EXPECT_EQ(samples.positions[21], cloud.positions[21]);
  EXPECT_EQ(samples.cameras[0], 0);
  EXPECT_EQ(*samples.EyeOf(0), Eigen::Vector3d(0, 0, 11));
  EXPECT_EQ(samples.weights[0], 1);
}

TEST(ThinCloud, StaysBelowTheLimitAndKeepsEveryPointsWeight) {
  const PointCloud cloud = Grid(200, 0.05);
  const Samples samples = ThinCloud(StreamOf(cloud), OnePhoto(), 3000, 0);
  EXPECT_LE(samples.size(), 3000u);
  EXPECT_GE(samples.size(), 1500u);
  int weight = 0;
  for (const int w : samples.weights) weight += w;
  EXPECT_EQ(weight, 40000);
  for (const auto& p : samples.positions) EXPECT_NEAR(p.z(), 1, 1e-12);
}

// Of a hall or a row of houses that are too many to be seen as closely as wanted.
TEST(ThinInside, IsAsFineAsTheLimitAllows) {
  const PointCloud cloud = Grid(400, 0.05);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(-1, -1, 0), Eigen::Vector3d(21, 21, 2));
  const Samples samples = ThinInside(box, StreamOf(cloud), OnePhoto(), 3000, 0.01);
  EXPECT_LE(samples.size(), 3000u);
  EXPECT_GE(samples.size(), 1300u);
}

// Cells somewhat larger than points lie apart are hardly fewer than the points.
TEST(ThinCloud, FindsTheCellsOfHardlyTooManyPointsAtOnce) {
  PointCloud cloud;
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(0, 100);
  for (int i = 0; i < 21000; ++i) cloud.positions.emplace_back(place(random), place(random), 0);
  const PointStream stream = StreamOf(cloud);
  int readings = 0;
  const PointStream counted{stream.count, [&](const auto& visit) {
                              ++readings;
                              stream.for_each(visit);
                            }};
  const Samples samples = ThinCloud(counted, {}, 20000, 0);
  EXPECT_LE(samples.size(), 20000U);
  EXPECT_GE(samples.size(), 15000U);
  EXPECT_LE(readings, 4);  // the box, the count, the sums; and once more at most
}

TEST(ThinCloud, GivesTheSameFromAFileAsFromMemory) {
  PointCloud cloud = Grid(150, 0.05);
  for (size_t i = 0; i < cloud.size(); ++i) cloud.positions[i].z() += 0.01 * std::sin(double(i));
  const auto file = std::filesystem::path(::testing::TempDir()) / "stucco_thin_cloud.ply";
  WritePly(cloud, file);
  for (const int max_points : {2000, 100000}) {
    const Samples held = ThinCloud(StreamOf(cloud), OnePhoto(), max_points, 0);
    const Samples read = ThinCloud(StreamOf(file), OnePhoto(), max_points, 0);
    EXPECT_EQ(held.positions, read.positions);
    EXPECT_EQ(held.normals, read.normals);
    EXPECT_EQ(held.weights, read.weights);
    EXPECT_EQ(held.cameras, read.cameras);
    EXPECT_EQ(held.cell, read.cell);
  }
  std::filesystem::remove(file);
}

// What lies in a small box is read without most of a cloud that was written place by place.
TEST(CloudBlocks, ReadWhatIsNear) {
  PointCloud cloud;
  constexpr int kSide = 500;
  for (int x = 0; x < kSide; ++x) {
    for (int y = 0; y < kSide; ++y) cloud.positions.emplace_back(0.1 * x, 0.1 * y, 1);
  }
  cloud.views.resize(cloud.size());
  for (uint32_t i = 0; i < cloud.size(); ++i) cloud.views[i].assign(i % 2, i);
  const auto file = std::filesystem::path(::testing::TempDir()) / "stucco_cloud_blocks.ply";
  WritePly(cloud, file);
  const Eigen::AlignedBox3d box(Eigen::Vector3d(30, 10, 0), Eigen::Vector3d(32, 12, 2));
  for (const PointStream& stream : {StreamOf(cloud), StreamOf(file)}) {
    const PointStream near = CloudBlocks(stream).Near(box);
    std::vector<Eigen::Vector3d> inside;
    size_t read = 0;
    near.for_each([&](const CloudPoint& point) {
      ++read;
      if (box.contains(point.position)) inside.push_back(point.position);
    });
    EXPECT_EQ(read, near.count);
    EXPECT_LT(read, cloud.size() / 3);
    std::vector<Eigen::Vector3d> expected;
    std::ranges::copy_if(cloud.positions, std::back_inserter(expected),
                         [&](const Eigen::Vector3d& p) { return box.contains(p); });
    EXPECT_EQ(inside, expected);
  }
  const PointStream whole{cloud.size(), StreamOf(cloud).for_each};
  EXPECT_EQ(CloudBlocks(whole).Near(box).count, cloud.size());
  std::filesystem::remove(file);
}

// A stream of two million points that nobody holds.
TEST(ThinCloud, ThinsWhatItNeverHolds) {
  constexpr int kSide = 1400;
  const PointStream stream{size_t{kSide} * kSide, [](const auto& visit) {
                             CloudPoint point;
                             point.normal = Eigen::Vector3f::UnitZ();
                             for (int x = 0; x < kSide; ++x) {
                               for (int y = 0; y < kSide; ++y) {
                                 point.position = {0.01 * x, 0.01 * y, 0};
                                 visit(point);
                               }
                             }
                           }};
  const Samples samples = ThinCloud(stream, {}, 5000, 0);
  EXPECT_LE(samples.size(), 5000u);
  EXPECT_GE(samples.size(), 3500u);
  const Samples coarse = ThinCloud(stream, {}, 5000, 1.0);
  EXPECT_EQ(coarse.cell, 1.0);
  EXPECT_NEAR(static_cast<double>(coarse.size()), 15 * 15, 31);
}

TEST(ThinCloud, DropsPointsThatAreNotFiniteOrFarAway) {
  PointCloud cloud = Grid(20, 0.1);
  cloud.positions[3].x() = std::numeric_limits<double>::quiet_NaN();
  cloud.positions[4].y() = std::numeric_limits<double>::infinity();
  cloud.positions[5] = {1e7, 0, 0};
  const Samples samples = ThinCloud(StreamOf(cloud), OnePhoto(), 1000, 0);
  EXPECT_EQ(samples.size(), 397u);
  EXPECT_EQ(samples.dropped, 3u);
}

TEST(ThinCloud, TakesCloudsWithoutNormalsViewsOrPoints) {
  PointCloud cloud;
  EXPECT_EQ(ThinCloud(StreamOf(cloud), OnePhoto(), 1000, 0).size(), 0u);
  cloud.positions = {{0, 0, 0}, {1, 0, 0}};
  const Samples samples = ThinCloud(StreamOf(cloud), OnePhoto(), 1000, 0);
  ASSERT_EQ(samples.size(), 2u);
  EXPECT_EQ(samples.cameras[0], -1);
  EXPECT_EQ(samples.EyeOf(0), nullptr);
  EXPECT_EQ(samples.normals[0].norm(), 0);
}

TEST(MeasureScale, FindsSpacingNoiseAndViewingDistance) {
  PointCloud cloud = Grid(60, 0.1);
  for (size_t i = 0; i < cloud.size(); ++i) cloud.positions[i].z() += i % 2 == 0 ? 0.02 : -0.02;
  const Samples samples = ThinCloud(StreamOf(cloud), OnePhoto(), 100000, 0);
  const CloudScale scale = MeasureScale(samples);
  EXPECT_NEAR(scale.spacing, 0.1, 0.015);
  EXPECT_NEAR(scale.noise, 0.02, 0.004);
  EXPECT_GT(scale.viewing_distance, 10);
  EXPECT_LT(scale.viewing_distance, 13);
}

TEST(DeriveTolerances, FollowScaleMetricAndOptions) {
  const CloudScale scale{.spacing = 0.01, .noise = 0.002, .viewing_distance = 5, .extent = 10};
  EXPECT_DOUBLE_EQ(DeriveTolerances(scale, true, {}).level_of_detail, 0.3);
  EXPECT_DOUBLE_EQ(DeriveTolerances(scale, false, {}).level_of_detail, 0.04);
  EXPECT_DOUBLE_EQ(DeriveTolerances(scale, false, {.level_of_detail = 0.5}).epsilon, 0.25);
  const CloudScale noisy{.spacing = 0.01, .noise = 0.2, .viewing_distance = 5, .extent = 10};
  EXPECT_DOUBLE_EQ(DeriveTolerances(noisy, true, {}).level_of_detail, 0.6);
}

TEST(DeriveTolerances, GrowTogetherWithACoarseSpacing) {
  const CloudScale coarse{.spacing = 0.7, .noise = 0.02, .viewing_distance = 60, .extent = 700};
  const Tolerances derived = DeriveTolerances(coarse, true, {});
  EXPECT_DOUBLE_EQ(derived.level_of_detail, 1.4);
  EXPECT_DOUBLE_EQ(derived.epsilon, 0.7);
  EXPECT_DOUBLE_EQ(derived.fill_gap, 4.2);
  EXPECT_NEAR(derived.min_area, 24.01, 1e-9);
  EXPECT_EQ(LeastPoints(derived), 19);
  // What the user says stays; only the rest follows the spacing.
  const Tolerances given = DeriveTolerances(coarse, true, {.level_of_detail = 0.3, .min_area = 5});
  EXPECT_DOUBLE_EQ(given.level_of_detail, 0.3);
  EXPECT_DOUBLE_EQ(given.min_area, 5);
  EXPECT_DOUBLE_EQ(given.fill_gap, 4.2);
  EXPECT_EQ(LeastPoints(given), 12);
  const CloudScale fine{.spacing = 0.06, .noise = 0.01, .viewing_distance = 60, .extent = 700};
  EXPECT_DOUBLE_EQ(DeriveTolerances(fine, true, {}).min_area, 2.25);
  EXPECT_EQ(LeastPoints(DeriveTolerances(fine, true, {})), 60);
}

TEST(GridIndex, FindsExactlyThePointsWithinTheRadius) {
  const PointCloud cloud = Grid(30, 0.1);
  const GridIndex index(cloud.positions, 0.37);
  const Eigen::Vector3d center(1.23, 0.51, 1.1);
  for (const double radius : {0.0, 0.15, 0.4, 5.0}) {
    size_t found = 0, expected = 0;
    index.ForEachNear(center, radius, [&](int) { ++found; });
    for (const auto& p : cloud.positions) expected += (p - center).norm() <= radius;
    EXPECT_EQ(found, expected) << radius;
  }
}

// Samples 1.5 m apart have roofs beside the ground among their neighbours: that is no noise.
TEST(DeriveTolerances, TakesForNoiseOnlyWhatSamplesCanShow) {
  const Tolerances noisy = DeriveTolerances({.spacing = 0.1, .noise = 0.2}, true, {});
  EXPECT_NEAR(noisy.level_of_detail, 0.6, 1e-9);
  EXPECT_NEAR(noisy.coarseness, 1, 1e-9);
  const Tolerances sparse = DeriveTolerances({.spacing = 1.5, .noise = 1.5}, true, {});
  EXPECT_NEAR(sparse.level_of_detail, 3, 1e-9);
  EXPECT_NEAR(sparse.level_of_detail / sparse.coarseness, 0.3, 1e-9);
}

}  // namespace
}  // namespace stucco
