// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/outliers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "tests/survey/temporary_folder.h"

namespace stucco::test {
namespace {

class Outliers : public testing::Test {
 protected:
  void Add(const Eigen::Vector3d& position, float spacing) {
    const std::vector<uint32_t> views(file_->size() % 3, 7);
    FusedPoint point;
    point.point.position = position;
    point.point.views = views;
    point.spacing = spacing;
    file_->Add(point);
  }

  // A wall of 30 x 30 points with four strays among them; returns which are of the wall.
  std::vector<bool> AddWallWithStrays(const Eigen::Vector3d& origin) {
    std::vector<bool> of_wall;
    for (int i = 0; i < 900; ++i) {
      Add(origin + Eigen::Vector3d(0.1 * (i % 30), 0.001 * (i % 7), 0.1 * (i / 30)), 0.1f);
      of_wall.push_back(true);
      if (i % 250 != 100) continue;
      Add(origin + Eigen::Vector3d(1, 4 + 0.01 * i, 1), 0.1f);
      of_wall.push_back(false);
    }
    return of_wall;
  }

  // A wall seen from near, a smaller one whose points are ten times as far apart, and a stray.
  void AddNearAndFarWallAndStray(float far_spacing) {
    for (int i = 0; i < 10'000; ++i) Add({0.01 * (i % 100), 0, 0.01 * (i / 100)}, 0.01f);
    for (int i = 0; i < 100; ++i) Add({50 + 0.1 * (i % 10), 0, 0.1 * (i / 10)}, far_spacing);
    Add({0.5, 2, 0.5}, 0.01f);
  }

  std::vector<bool> Find(const OutlierOptions& options) {
    return FindInliers(*file_, options, folder_.path());
  }

  size_t Removed(const OutlierOptions& options) {
    return static_cast<size_t>(std::ranges::count(Find(options), false));
  }

  TemporaryFolder folder_;
  std::unique_ptr<FusedPointsFile> file_ = std::make_unique<FusedPointsFile>(folder_.path());
};

TEST_F(Outliers, AreStrays) {
  const std::vector<bool> of_wall = AddWallWithStrays({0, 0, 0});
  EXPECT_EQ(Find({.sigmas = 3, .threads = 2}), of_wall);
}

TEST_F(Outliers, AreFoundFarFromTheOrigin) {
  const std::vector<bool> of_wall = AddWallWithStrays({431000, 5412000, 250});
  EXPECT_EQ(Find({.sigmas = 3}), of_wall);
}

TEST_F(Outliers, AreTheSameInSlabsOfAnySize) {
  for (int k = 0; k < 5; ++k) AddWallWithStrays({3.0 * k, 0.3 * k, 0});
  const std::vector<bool> whole = Find({.sigmas = 1});
  EXPECT_GT(std::ranges::count(whole, false), 4);
  for (const size_t points : {2000u, 700u, 100u}) {
    EXPECT_EQ(Find({.sigmas = 1, .threads = 2, .points_of_slab = points}), whole) << points;
  }
}

TEST_F(Outliers, AreNoneUnderLaxLimits) {
  AddWallWithStrays({0, 0, 0});
  EXPECT_EQ(Removed({.sigmas = 1000}), 0u);
}

TEST_F(Outliers, AreNoneInSmallClouds) {
  EXPECT_TRUE(Find({.sigmas = 1}).empty());
  for (int i = 0; i < 10; ++i) Add({std::pow(2.0, i), 0, 0}, 0.1f);
  EXPECT_EQ(Removed({.sigmas = 1}), 0u);
}

TEST_F(Outliers, AreNotWhatWasSeenFromAfar) {
  AddNearAndFarWallAndStray(0.1f);
  const std::vector<bool> inliers = Find({.sigmas = 3});
  EXPECT_EQ(std::ranges::count(inliers, false), 1);
  EXPECT_FALSE(inliers.back());
}

TEST_F(Outliers, AreWhatLiesFartherApartThanItsPixels) {
  AddNearAndFarWallAndStray(0.01f);
  EXPECT_EQ(Removed({.sigmas = 3}), 101u);
}

TEST_F(Outliers, LeaveNoFilesBehind) {
  AddWallWithStrays({0, 0, 0});
  Find({.points_of_slab = 100});
  EXPECT_TRUE(std::filesystem::is_empty(folder_.path()));
}

}  // namespace
}  // namespace stucco::test
