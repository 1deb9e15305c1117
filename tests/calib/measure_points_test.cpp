// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/measure_points.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calib/made_control.h"

namespace stucco::test {
namespace {

constexpr double kMinAngle_rad = 0.026;

Scene MakePhotos() {
  MadeOptions options;
  options.num_photos = 10;
  return MakeScene(options);
}

TEST(MeasurePoints, FindsPointsWhereTheyAre) {
  const Scene scene = MakePhotos();
  const auto corners = MadeCorners();
  const GroundControl control = MakeControl(scene, MadeFrame(), corners, 0);
  const auto measured = MeasurePoints(scene, control.points, kMinAngle_rad);
  ASSERT_EQ(measured.size(), corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    ASSERT_TRUE(measured[i].position) << measured[i].why_not;
    EXPECT_LT((*measured[i].position - corners[i]).norm(), 1e-6);
    EXPECT_EQ(measured[i].used.size(), control.points[i].marks.size());
    EXPECT_LT(measured[i].reprojection_error_px, 1e-4);
    // 20 m away with a focal length of 1000 pixels.
    EXPECT_NEAR(measured[i].ground_pixel, 0.02, 0.008);
  }
}

TEST(MeasurePoints, ErrorsAreWhatTheCovarianceSays) {
  const Scene scene = MakePhotos();
  double sum = 0;
  int count = 0;
  const std::vector<Eigen::Vector3d> corners(40, Eigen::Vector3d(0, -2, 6));
  const GroundControl control = MakeControl(scene, MadeFrame(), corners, kMarkSigma_px);
  for (const MeasuredPoint& point : MeasurePoints(scene, control.points, kMinAngle_rad)) {
    ASSERT_TRUE(point.position);
    const Eigen::Vector3d error = *point.position - corners[0];
    sum += error.dot(point.covariance.inverse() * error);
    count += 3;
  }
  // The mean of 120 squares of normal variables: its standard deviation is 0.13.
  EXPECT_NEAR(sum / count, 1, 0.4);
}

TEST(MeasurePoints, RefusesAMarkOfAnotherPlace) {
  const Scene scene = MakePhotos();
  GroundControl control = MakeControl(scene, MadeFrame(), MadeCorners(), 0.3);
  control.points[0].marks[2].pixel.y() += 60;
  const auto measured = MeasurePoints(scene, control.points, kMinAngle_rad);
  ASSERT_TRUE(measured[0].position);
  ASSERT_EQ(measured[0].refused.size(), 1u);
  EXPECT_EQ(measured[0].refused[0].photo, control.points[0].marks[2].photo);
  EXPECT_LT((*measured[0].position - MadeCorners()[0]).norm(), 0.03);
}

TEST(MeasurePoints, NeedsTwoPhotosWithPoses) {
  Scene scene = MakePhotos();
  GroundControl control = MakeControl(scene, MadeFrame(), MadeCorners(), 0);
  control.points[0].marks.resize(2);
  scene.photos[control.points[0].marks[0].photo].pose.reset();
  control.points[1].marks.clear();
  const auto measured = MeasurePoints(scene, control.points, kMinAngle_rad);
  EXPECT_FALSE(measured[0].position);
  EXPECT_NE(measured[0].why_not.find("1 photo with a pose"), std::string::npos);
  EXPECT_FALSE(measured[1].position);
  EXPECT_NE(measured[1].why_not.find("no line"), std::string::npos);
}

TEST(MeasurePoints, NeedsAnAngle) {
  MadeOptions options;
  options.num_photos = 6;
  options.arc_rad = 0.001;
  options.num_points = 50;
  Scene scene = MakeScene(options);
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    scene.photos[i].pose = LookAt({0.01 * static_cast<double>(i), -20, 4}, {0, 0, 3.5});
  }
  const GroundControl control = MakeControl(scene, MadeFrame(), {{0, -2, 6}}, 0.2);
  const auto measured = MeasurePoints(scene, control.points, kMinAngle_rad);
  EXPECT_FALSE(measured[0].position);
  EXPECT_NE(measured[0].why_not.find("angle"), std::string::npos);
}

}  // namespace
}  // namespace stucco::test
