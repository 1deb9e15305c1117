// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/outliers.h"

#include <gtest/gtest.h>

#include <cmath>

namespace stucco::test {
namespace {

// A wall of 30 x 30 points with four strays among them.
PointCloud WallWithStrays(const Eigen::Vector3d& origin) {
  PointCloud cloud;
  for (int i = 0; i < 900; ++i) {
    cloud.positions.push_back(origin +
                              Eigen::Vector3d(0.1 * (i % 30), 0.001 * (i % 7), 0.1 * (i / 30)));
    if (i % 250 == 100) {
      cloud.positions.push_back(origin + Eigen::Vector3d(1, 4 + 0.01 * i, 1));
    }
  }
  for (size_t i = 0; i < cloud.positions.size(); ++i) {
    cloud.normals.emplace_back(0, -1, 0);
    cloud.colors.push_back({static_cast<uint8_t>(i % 256), static_cast<uint8_t>(i / 256), 0});
    cloud.views.push_back({static_cast<uint32_t>(i)});
  }
  return cloud;
}

size_t Remove(double sigmas, PointCloud& cloud) {
  return RemoveOutliers(sigmas, std::vector<float>(cloud.size(), 0.1f), 2, cloud);
}

void ExpectStraysGone(const Eigen::Vector3d& origin) {
  const PointCloud before = WallWithStrays(origin);
  PointCloud cloud = before;
  EXPECT_EQ(Remove(3, cloud), 4u);
  ASSERT_EQ(cloud.size(), 900u);
  EXPECT_FALSE(FindProblem(cloud));
  for (size_t i = 0; i < cloud.size(); ++i) {
    EXPECT_LT(cloud.positions[i].y() - origin.y(), 1);
    // What belongs to a point went with it.
    const uint32_t was = cloud.views[i].at(0);
    EXPECT_EQ(cloud.positions[i], before.positions[was]);
    EXPECT_EQ(cloud.colors[i], before.colors[was]);
    if (i > 0) {
      EXPECT_LT(cloud.views[i - 1].at(0), was);
    }
  }
}

TEST(RemoveOutliers, DropsStrays) {
  ExpectStraysGone({0, 0, 0});
}

TEST(RemoveOutliers, WorksFarFromTheOrigin) {
  ExpectStraysGone({431000, 5412000, 250});
}

TEST(RemoveOutliers, KeepsEverythingUnderLaxLimits) {
  PointCloud cloud = WallWithStrays({0, 0, 0});
  EXPECT_EQ(Remove(1000, cloud), 0u);
  EXPECT_EQ(cloud.size(), 904u);
}

TEST(RemoveOutliers, LeavesSmallCloudsAlone) {
  PointCloud cloud;
  EXPECT_EQ(Remove(1, cloud), 0u);
  for (int i = 0; i < 10; ++i) cloud.positions.emplace_back(std::pow(2.0, i), 0, 0);
  EXPECT_EQ(Remove(1, cloud), 0u);
  EXPECT_EQ(cloud.size(), 10u);
}

TEST(RemoveOutliers, TakesCloudsWithoutAttributes) {
  PointCloud cloud;
  cloud.positions = WallWithStrays({0, 0, 0}).positions;
  EXPECT_EQ(Remove(3, cloud), 4u);
  EXPECT_TRUE(cloud.normals.empty());
}

// A wall seen from near, and a smaller one from ten times as far.
TEST(RemoveOutliers, KeepsWhatWasSeenFromAfar) {
  PointCloud cloud;
  std::vector<float> spacing;
  for (int i = 0; i < 10'000; ++i) {
    cloud.positions.emplace_back(0.01 * (i % 100), 0, 0.01 * (i / 100));
    spacing.push_back(0.01f);
  }
  for (int i = 0; i < 100; ++i) {
    cloud.positions.emplace_back(50 + 0.1 * (i % 10), 0, 0.1 * (i / 10));
    spacing.push_back(0.1f);
  }
  cloud.positions.emplace_back(0.5, 2, 0.5);
  spacing.push_back(0.01f);
  PointCloud alike = cloud;
  EXPECT_EQ(RemoveOutliers(3, spacing, 1, cloud), 1u);
  EXPECT_EQ(cloud.size(), 10'100u);
  EXPECT_GT(RemoveOutliers(1, std::vector<float>(10'101, 0.01f), 1, alike), 1u);
}

}  // namespace
}  // namespace stucco::test
