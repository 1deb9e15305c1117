// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/resect.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

constexpr int kPhoto = 3;

// Moves the given share of the photo's keypoints to random places.
void Spoil(double share, Scene& scene) {
  Random random(7);
  for (Eigen::Vector2d& keypoint : scene.photos[kPhoto].keypoints) {
    if (random.Uniform(0, 1) < share) {
      keypoint = {random.Uniform(0, 1200), random.Uniform(0, 900)};
    }
  }
}

double AngleBetween(const Pose& a, const Pose& b) {
  return a.rotation.angularDistance(b.rotation);
}

TEST(Resect, RecoversExactPose) {
  for (const CameraModel model :
       {CameraModel::kPinhole, CameraModel::kOpenCv, CameraModel::kFullOpenCv}) {
    Scene scene = MakeScene({.num_points = 150, .model = model});
    const Pose expected = *scene.photos[kPhoto].pose;
    scene.photos[kPhoto].pose.reset();
    const auto found = Resect(scene, kPhoto, 4, 15);
    ASSERT_TRUE(found);
    EXPECT_LT((found->cam_from_world.Center() - expected.Center()).norm(), 1e-5);
    EXPECT_LT(AngleBetween(found->cam_from_world, expected), 1e-6);
    EXPECT_EQ(found->num_inliers, found->num_points);
    EXPECT_EQ(found->num_points, NumVisiblePoints(scene, kPhoto));
  }
}

TEST(Resect, StaysWithinNoise) {
  Scene scene = MakeScene({.num_points = 300, .noise_px = 1});
  const Pose expected = *scene.photos[kPhoto].pose;
  const auto found = Resect(scene, kPhoto, 4, 15);
  ASSERT_TRUE(found);
  EXPECT_LT((found->cam_from_world.Center() - expected.Center()).norm(), 0.05);
  EXPECT_LT(AngleBetween(found->cam_from_world, expected), 0.002);
}

TEST(Resect, SurvivesHalfWrongPoints) {
  Scene scene = MakeScene({.num_points = 300, .noise_px = 0.5});
  Spoil(0.5, scene);
  const auto found = Resect(scene, kPhoto, 4, 15);
  ASSERT_TRUE(found);
  EXPECT_LT((found->cam_from_world.Center() - scene.photos[kPhoto].pose->Center()).norm(), 0.1);
  EXPECT_LT(found->num_inliers, 0.65 * found->num_points);
  EXPECT_GT(found->num_inliers, 0.35 * found->num_points);
}

TEST(Resect, RefusesWhenNothingAgrees) {
  Scene scene = MakeScene({.num_points = 200});
  Spoil(1, scene);
  EXPECT_FALSE(Resect(scene, kPhoto, 4, 30));
}

TEST(Resect, RefusesTooFewPoints) {
  Scene scene = MakeScene({.num_points = 200});
  int kept = 0;
  for (SceneTrack& track : scene.tracks) {
    if (++kept > 10) track.position.reset();
  }
  EXPECT_FALSE(Resect(scene, kPhoto, 4, 15));
  for (SceneTrack& track : scene.tracks) track.position.reset();
  EXPECT_EQ(NumVisiblePoints(scene, kPhoto), 0);
  EXPECT_FALSE(Resect(scene, kPhoto, 4, 0));
}

TEST(Resect, IsRepeatable) {
  Scene scene = MakeScene({.num_points = 200, .noise_px = 1});
  Spoil(0.4, scene);
  const auto first = Resect(scene, kPhoto, 4, 15);
  const auto second = Resect(scene, kPhoto, 4, 15);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->cam_from_world.rotation.coeffs(), second->cam_from_world.rotation.coeffs());
  EXPECT_EQ(first->cam_from_world.translation, second->cam_from_world.translation);
}

TEST(VisibilityScore, PrefersPointsSpreadOverThePicture) {
  Scene scene = MakeScene({.num_points = 100});
  const int spread = VisibilityScore(scene, kPhoto);
  for (size_t k = 0; k < scene.photos[kPhoto].keypoints.size(); ++k) {
    scene.photos[kPhoto].keypoints[k] = {600.5 + 0.1 * k, 450.5};
  }
  const int crowded = VisibilityScore(scene, kPhoto);
  EXPECT_GT(crowded, 0);
  EXPECT_GT(spread, 5 * crowded);
}

}  // namespace
}  // namespace stucco::test
