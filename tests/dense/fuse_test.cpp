// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/fuse.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "tests/dense/made_views.h"

namespace stucco::test {
namespace {

class Fusing : public testing::Test {
 protected:
  void Make(int count, const std::vector<MadePlane>& planes) {
    planes_ = planes;
    poses_ = PosesAround(count);
    for (int i = 0; i < count; ++i) {
      input_.ids.push_back({static_cast<uint32_t>(10 * (count - i))});  // not in order
      input_.cameras.push_back(PinholeLevels(SmallCamera(), poses_[i], 0, 1)[0]);
      std::vector<int>& sources = input_.neighbours.emplace_back();
      for (int s = 0; s < count; ++s) {
        if (s != i) sources.push_back(s);
      }
      maps_.push_back(std::make_shared<DepthMap>(TrueDepths(input_.cameras[i], planes)));
      auto pyramid = std::make_shared<ViewPyramid>();
      pyramid->color = Render(input_.cameras[i], planes);
      colors_.push_back(pyramid);
    }
  }

  PointCloud Run(const FuseOptions& options = {}) {
    input_.map = [this](int i) { return maps_[i]; };
    input_.colors = [this](int i) { return colors_[i]; };
    PointCloud cloud;
    spacing_.clear();
    Fuse(input_, options, [&](const FusedPoints& points) {
      ++photos_done_;
      for (size_t i = 0; i < points.size(); ++i) {
        const FusedPoint fused = points.at(i);
        const CloudPoint& point = fused.point;
        cloud.positions.push_back(point.position);
        cloud.normals.push_back(point.normal);
        cloud.colors.push_back(point.color);
        cloud.views.emplace_back(point.views.begin(), point.views.end());
        spacing_.push_back(fused.spacing);
      }
    });
    return cloud;
  }

  double DistanceFromPlanes(const Eigen::Vector3d& point) const {
    double least = 1e9;
    for (const MadePlane& plane : planes_) least = std::min(least, plane.Distance(point));
    return least;
  }

  std::vector<MadePlane> planes_;
  std::vector<Pose> poses_;
  FuseInput input_;
  std::vector<std::shared_ptr<DepthMap>> maps_;
  std::vector<std::shared_ptr<const ViewPyramid>> colors_;
  std::vector<float> spacing_;  // of the cloud's points
  int photos_done_ = 0;
};

TEST_F(Fusing, TwoWallsBecomeOneCloud) {
  Make(4, TwoWalls());
  const PointCloud cloud = Run();
  EXPECT_FALSE(FindProblem(cloud)) << *FindProblem(cloud);
  EXPECT_EQ(photos_done_, 4);
  // Each place once, not once per photo: 30 000 pixels a photo.
  EXPECT_GT(cloud.size(), 20000u);
  EXPECT_LT(cloud.size(), 40000u);
  for (const Eigen::Vector3d& p : cloud.positions) EXPECT_LT(DistanceFromPlanes(p), 0.003);
}

TEST_F(Fusing, NormalsFaceTheCamerasThatSeeThePoint) {
  Make(4, TwoWalls());
  const PointCloud cloud = Run();
  for (size_t i = 0; i < cloud.size(); ++i) {
    ASSERT_GE(cloud.views[i].size(), 3u);
    EXPECT_TRUE(std::is_sorted(cloud.views[i].begin(), cloud.views[i].end()));
    EXPECT_NEAR(cloud.normals[i].norm(), 1, 1e-4);
    for (const uint32_t id : cloud.views[i]) {
      const Eigen::Vector3d center = poses_.at(4 - id / 10).Center();
      EXPECT_GT((center - cloud.positions[i]).normalized().dot(cloud.normals[i].cast<double>()), 0);
    }
  }
}

TEST_F(Fusing, ColoursComeFromThePhotos) {
  Make(3, {SlantedWall()});
  const PointCloud cloud = Run();
  ASSERT_GT(cloud.size(), 1000u);
  const PinholeCamera& view = input_.cameras[0];
  int checked = 0;
  for (size_t i = 0; i < cloud.size() && checked < 500; ++i) {
    const Eigen::Vector3d p = poses_[0] * cloud.positions[i];
    const double x = view.fx * p.x() / p.z() + view.cx;
    const double y = view.fy * p.y() / p.z() + view.cy;
    if (std::abs(x - std::round(x)) > 1e-3 || std::abs(y - std::round(y)) > 1e-3) continue;
    if (!colors_[0] || x < 0 || y < 0 || x > view.width - 1 || y > view.height - 1) continue;
    const auto column = static_cast<int>(std::lround(x));
    const auto row = static_cast<int>(std::lround(y));
    EXPECT_EQ(cloud.colors[i][0], *colors_[0]->color.Pixel(column, row));
    ++checked;
  }
  EXPECT_EQ(checked, 500);
}

TEST_F(Fusing, DropsWhatOthersDoNotConfirm) {
  Make(4, {SlantedWall()});
  const size_t clean = Run().size();
  // A block of the first photo, and noise all over the second.
  for (int y = 40; y < 90; ++y) {
    for (int x = 50; x < 120; ++x) maps_[0]->depths[maps_[0]->Index(x, y)] *= 1.1f;
  }
  for (size_t i = 0; i < maps_[1]->depths.size(); i += 5) maps_[1]->depths[i] *= 0.85f;
  const PointCloud cloud = Run();
  EXPECT_GT(cloud.size(), clean / 2);
  for (const Eigen::Vector3d& p : cloud.positions) EXPECT_LT(DistanceFromPlanes(p), 0.003);
}

TEST_F(Fusing, NeedsAsManyPhotosAsAsked) {
  Make(3, {SlantedWall()});
  EXPECT_EQ(Run({.min_consistent = 3}).size(), 0u);
  const size_t by_three = Run({.min_consistent = 2}).size();
  const size_t by_two = Run({.min_consistent = 1}).size();
  EXPECT_GT(by_three, 1000u);
  EXPECT_GT(by_two, by_three);
  *maps_[2] = EmptyDepthMap(200, 150);
  EXPECT_EQ(Run({.min_consistent = 2}).size(), 0u);
  EXPECT_GT(Run({.min_consistent = 1}).size(), 1000u);
}

TEST_F(Fusing, DropsPoorMatches) {
  Make(3, {SlantedWall()});
  for (auto& map : maps_) std::fill(map->costs.begin(), map->costs.end(), uint8_t{100});
  EXPECT_EQ(Run({.max_cost = 0.7f}).size(), 0u);
  EXPECT_GT(Run({.max_cost = 0.8f}).size(), 1000u);
}

TEST_F(Fusing, DropsContradictingNormals) {
  Make(2, {SlantedWall()});
  EXPECT_GT(Run({.min_consistent = 1}).size(), 1000u);
  for (auto& normal : maps_[1]->normals) normal = {-120, 0, -40};
  EXPECT_EQ(Run({.min_consistent = 1}).size(), 0u);
}

TEST_F(Fusing, AveragesNoise) {
  Make(5, {SlantedWall()});
  // Half a per cent, different in every photo.
  uint32_t state = 1;
  double one_photo = 0;
  for (auto& map : maps_) {
    for (float& depth : map->depths) {
      state = state * 1664525u + 1013904223u;
      const float noise = 0.01f * (static_cast<float>(state >> 8) * 0x1p-24f - 0.5f);
      depth *= 1 + noise;
      one_photo += std::abs(noise) * 5 / (5.0 * map->depths.size());
    }
  }
  const PointCloud cloud = Run({.min_consistent = 3, .max_depth_difference = 0.03f});
  ASSERT_GT(cloud.size(), 1000u);
  double sum = 0;
  for (const Eigen::Vector3d& p : cloud.positions) sum += DistanceFromPlanes(p) / cloud.size();
  EXPECT_LT(sum, 0.7 * one_photo);
}

TEST_F(Fusing, MakesASurfaceOnceWhereverItIsSeen) {
  Make(5, {SlantedWall()});
  const PointCloud cloud = Run({.min_consistent = 1});
  size_t twice = 0;
  // Points of other photos lie between those of the first, not on them.
  std::set<std::pair<long, long>> cells;
  const double cell = 0.7 * spacing_.at(0);
  for (const Eigen::Vector3d& p : cloud.positions) {
    const Eigen::Vector3d from = p - planes_[0].center;
    const auto place = std::pair(std::lround(from.dot(planes_[0].u) / cell),
                                 std::lround(from.dot(planes_[0].v) / cell));
    twice += !cells.insert(place).second;
  }
  EXPECT_LT(twice, cloud.size() / 10);
}

TEST_F(Fusing, IsTheSameWithAnyNumberOfThreads) {
  Make(4, TwoWalls());
  const PointCloud one = Run();
  const PointCloud four = Run({.threads = 4});
  EXPECT_EQ(one.positions, four.positions);
  EXPECT_EQ(one.views, four.views);
}

// A photo from twice as far is worth a quarter where they differ, and its pixels make no points
// where there are finer ones.
TEST_F(Fusing, BelievesTheNearerPhoto) {
  const std::vector<MadePlane> planes = {SlantedWall()};
  Make(2, planes);
  poses_[1].translation += Eigen::Vector3d(0, 0, 5);
  input_.cameras[1] = PinholeLevels(SmallCamera(), poses_[1], 0, 1)[0];
  *maps_[1] = TrueDepths(input_.cameras[1], planes);
  for (float& depth : maps_[1]->depths) depth *= 1.004f;
  const PointCloud cloud = Run({.min_consistent = 1});
  ASSERT_GT(cloud.size(), 1000u);
  double sum = 0;
  for (const Eigen::Vector3d& p : cloud.positions) sum += DistanceFromPlanes(p);
  const double off = 0.004 * 10;  // metres along the far photo's rays
  EXPECT_GT(sum / static_cast<double>(cloud.size()), 0.1 * off);
  EXPECT_LT(sum / static_cast<double>(cloud.size()), 0.3 * off);
}

TEST_F(Fusing, NothingFromNothing) {
  EXPECT_EQ(Run().size(), 0u);
  Make(2, {});
  EXPECT_EQ(Run({.min_consistent = 1}).size(), 0u);
}

}  // namespace
}  // namespace stucco::test
