// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/triangulate.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

const Pose kToTheRight{Eigen::Quaterniond(Eigen::AngleAxisd(-0.2, Eigen::Vector3d::UnitY())),
                       {-1, 0.1, 0.05}};

TEST(TriangulateTwoRays, FindsExactPoint) {
  const Eigen::Vector3d point(0.4, -0.3, 5);
  const Eigen::Vector3d in_second = kToTheRight * point;
  const auto found = TriangulateTwoRays(point.hnormalized(), in_second.hnormalized(), kToTheRight);
  ASSERT_TRUE(found);
  EXPECT_LT((*found - point).norm(), 1e-9);
}

TEST(TriangulateTwoRays, RefusesParallelRays) {
  const Pose aside{Eigen::Quaterniond::Identity(), {-1, 0, 0}};
  EXPECT_FALSE(TriangulateTwoRays({0.1, 0.2}, {0.1, 0.2}, aside));
}

TEST(TriangulateTwoRays, RefusesPointsBehindACamera) {
  // The rays part in front of the cameras and would meet behind them.
  const Pose aside{Eigen::Quaterniond::Identity(), {-1, 0, 0}};
  EXPECT_FALSE(TriangulateTwoRays({-0.2, 0}, {0.2, 0}, aside));
  EXPECT_TRUE(TriangulateTwoRays({0.2, 0}, {-0.2, 0}, aside));
}

TEST(TriangulateTrack, RecoversExactPoints) {
  const Scene truth = MakeScene({.num_points = 60, .model = CameraModel::kFullOpenCv});
  for (const SceneTrack& expected : truth.tracks) {
    SceneTrack track = expected;
    ClearPoint(track);
    ASSERT_TRUE(TriangulateTrack(truth, {}, track));
    EXPECT_LT((*track.position - *expected.position).norm(), 1e-6);
    for (const SceneElement& e : track.elements) EXPECT_TRUE(e.used);
  }
}

TEST(TriangulateTrack, StaysWithinNoise) {
  const Scene truth = MakeScene({.num_points = 60, .noise_px = 0.5});
  for (const SceneTrack& expected : truth.tracks) {
    if (expected.elements.size() < 4) continue;
    SceneTrack track = expected;
    ASSERT_TRUE(TriangulateTrack(truth, {}, track));
    // Half a pixel is 1 cm at 20 m; depth is worse than that.
    EXPECT_LT((*track.position - *expected.position).norm(), 0.15);
  }
}

TEST(TriangulateTrack, GoesByTheSharpKeypoints) {
  Scene scene = MakeScene({.num_photos = 8, .num_points = 60, .seen_share = 1});
  SceneTrack& track = scene.tracks[0];
  const Eigen::Vector3d point = *track.position;
  for (ScenePhoto& photo : scene.photos) photo.blobs_px.assign(photo.keypoints.size(), 1);
  for (size_t i = 0; i < 3; ++i) {
    const SceneElement& e = track.elements[i];
    scene.photos[e.photo].keypoints[e.keypoint] += Eigen::Vector2d(2, -2);
  }
  ASSERT_TRUE(TriangulateTrack(scene, {}, track));
  const double off = (*track.position - point).norm();
  for (size_t i = 0; i < 3; ++i) {
    const SceneElement& e = track.elements[i];
    scene.photos[e.photo].blobs_px[e.keypoint] = 30;
  }
  ASSERT_TRUE(TriangulateTrack(scene, {}, track));
  EXPECT_LT((*track.position - point).norm(), off / 5);
}

TEST(TriangulateTrack, LeavesWrongElementsOut) {
  Scene scene = MakeScene({.num_points = 80, .seen_share = 1});
  int tried = 0;
  for (SceneTrack& track : scene.tracks) {
    if (track.elements.size() < 5) continue;
    ++tried;
    const Eigen::Vector3d expected = *track.position;
    for (const size_t wrong : {size_t{1}, size_t{3}}) {
      const SceneElement& e = track.elements[wrong];
      scene.photos[e.photo].keypoints[e.keypoint] += Eigen::Vector2d(40, wrong == 1 ? 25 : -60);
    }
    ASSERT_TRUE(TriangulateTrack(scene, {}, track));
    EXPECT_LT((*track.position - expected).norm(), 1e-6);
    for (size_t i = 0; i < track.elements.size(); ++i) {
      EXPECT_EQ(track.elements[i].used, i != 1 && i != 3);
    }
  }
  EXPECT_GT(tried, 20);
}

TEST(TriangulateTrack, RefusesNearlyParallelRays) {
  const Scene scene = MakeScene({.num_points = 60, .arc_rad = 0.01});
  ASSERT_FALSE(scene.tracks.empty());
  SceneTrack track = scene.tracks[0];
  // The heights of the positions differ by metres, so the limit is what refuses.
  EXPECT_FALSE(TriangulateTrack(scene, {.min_angle_rad = 0.5}, track));
  EXPECT_FALSE(track.position);
  for (const SceneElement& e : track.elements) EXPECT_FALSE(e.used);
}

TEST(TriangulateTrack, NeedsTwoPosedPhotos) {
  Scene scene = MakeScene({.num_photos = 3, .num_points = 40, .seen_share = 1});
  const auto whole = std::find_if(scene.tracks.begin(), scene.tracks.end(),
                                  [](const SceneTrack& t) { return t.elements.size() == 3; });
  ASSERT_NE(whole, scene.tracks.end());
  scene.photos[1].pose.reset();
  SceneTrack track = *whole;
  EXPECT_TRUE(TriangulateTrack(scene, {}, track));
  EXPECT_FALSE(track.elements[1].used);
  scene.photos[2].pose.reset();
  EXPECT_FALSE(TriangulateTrack(scene, {}, track));
  EXPECT_FALSE(track.position);
}

TEST(TriangulateTrack, RefusesElementsThatDisagree) {
  Scene scene = MakeScene({.num_photos = 2, .num_points = 40});
  ASSERT_FALSE(scene.tracks.empty());
  SceneTrack track = scene.tracks[0];
  const SceneElement& e = track.elements[1];
  scene.photos[e.photo].keypoints[e.keypoint].y() += 60;  // across the epipolar lines
  EXPECT_FALSE(TriangulateTrack(scene, {}, track));
}

}  // namespace
}  // namespace stucco::test
