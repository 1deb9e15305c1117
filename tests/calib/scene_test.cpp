// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/scene.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

TEST(Scene, MeasuresReprojectionErrors) {
  Scene scene = MakeScene({.num_photos = 3, .num_points = 40});
  const SceneTrack& track = scene.tracks[0];
  const SceneElement& e = track.elements[0];
  EXPECT_LT(ReprojectionError(scene, e, *track.position), 1e-9);
  scene.photos[e.photo].keypoints[e.keypoint] += Eigen::Vector2d(3, -4);
  EXPECT_NEAR(ReprojectionError(scene, e, *track.position), 5, 1e-9);
  const Eigen::Vector3d behind =
      scene.photos[e.photo].pose->Center() -
      scene.photos[e.photo].pose->rotation.conjugate() * Eigen::Vector3d(0, 0, 1);
  EXPECT_TRUE(std::isinf(ReprojectionError(scene, e, behind)));
  scene.photos[e.photo].pose.reset();
  EXPECT_TRUE(std::isinf(ReprojectionError(scene, e, *track.position)));
}

TEST(Scene, LargeBlobsAreLessSureThanSharpOnes) {
  ScenePhoto photo;
  photo.keypoint_sigma_px = 2;  // detected at half the size
  photo.keypoints.resize(3);
  EXPECT_EQ(photo.KeypointSigma(1), 2);
  photo.blobs_px = {0.1F, 20, 40};
  EXPECT_NEAR(photo.KeypointSigma(0), 2, 0.01);
  EXPECT_GT(photo.KeypointSigma(1), 2 * photo.KeypointSigma(0));
  EXPECT_NEAR(photo.KeypointSigma(2) / photo.KeypointSigma(1), 2, 0.15);
}

TEST(Scene, CountsPosesAndObservations) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 40});
  EXPECT_EQ(NumRegistered(scene), 4);
  const int all = static_cast<int>(scene.photos[1].keypoints.size());
  EXPECT_EQ(NumUsedObservations(scene, 1), all);
  const int track = scene.tracks_of_photo[1][0];
  scene.tracks[track].position.reset();
  EXPECT_EQ(NumUsedObservations(scene, 1), all - 1);
  for (SceneElement& e : scene.tracks[scene.tracks_of_photo[1][1]].elements) e.used = false;
  EXPECT_EQ(NumUsedObservations(scene, 1), all - 2);
  scene.tracks_of_photo[1][2] = -1;
  EXPECT_EQ(NumUsedObservations(scene, 1), all - 3);
  scene.photos[0].pose.reset();
  EXPECT_EQ(NumRegistered(scene), 3);
}

TEST(Scene, FindsTheLargestAngleOfUsedRays) {
  Scene scene;
  const Camera camera = MadeCamera(CameraModel::kPinhole);
  scene.cameras = {{camera, camera, 0.1}};
  const Eigen::Vector3d point(0, 0, 0);
  SceneTrack track;
  track.position = point;
  for (const double angle : {0.0, 0.1, 0.4}) {
    ScenePhoto photo;
    photo.pose = LookAt(10 * Eigen::Vector3d(std::sin(angle), -std::cos(angle), 0), point);
    track.elements.push_back({static_cast<int>(scene.photos.size()), 0, true});
    scene.photos.push_back(photo);
  }
  EXPECT_NEAR(LargestRayAngle(scene, track), 0.4, 1e-9);
  track.elements[2].used = false;
  EXPECT_NEAR(LargestRayAngle(scene, track), 0.1, 1e-9);
  track.elements[1].used = false;
  EXPECT_NEAR(LargestRayAngle(scene, track), 0, 1e-9);
}

TEST(Scene, IsConsistentWhenAllIndicesLeadSomewhere) {
  const Scene good = MakeScene({.num_photos = 3, .num_points = 40});
  EXPECT_TRUE(IsConsistent(good));
  EXPECT_TRUE(IsConsistent({}));
  Scene bad = good;
  bad.photos[1].camera = 1;
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.photos[1].blobs_px = {1};
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.tracks[0].elements[0].photo = 3;
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.tracks[0].elements[0].keypoint = -1;
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.tracks[0].elements.push_back(bad.tracks[0].elements[0]);
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.tracks_of_photo[2][0] = static_cast<int>(bad.tracks.size());
  EXPECT_FALSE(IsConsistent(bad));
  bad = good;
  bad.photos[2].keypoints.emplace_back(1, 1);  // not in tracks_of_photo
  EXPECT_FALSE(IsConsistent(bad));
  bad.tracks_of_photo.clear();  // not filled
  EXPECT_TRUE(IsConsistent(bad));
}

}  // namespace
}  // namespace stucco::test
