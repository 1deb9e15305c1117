// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/localise/place_in_model.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

#include "calib/scene/tracks.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

// The photos of a made scene that are new, with the points of all of it; their poses are to be
// found. The camera is known.
Scene NewPhotos(const Scene& truth, int count) {
  Scene scene;
  scene.cameras = truth.cameras;
  scene.cameras[0].focal_sigma_ratio = 0;
  scene.photos.assign(truth.photos.begin(), truth.photos.begin() + count);
  for (ScenePhoto& photo : scene.photos) photo.pose.reset();
  for (SceneTrack track : truth.tracks) {
    std::erase_if(track.elements, [&](const SceneElement& e) { return e.photo >= count; });
    for (SceneElement& element : track.elements) element.used = false;
    if (!track.elements.empty()) scene.tracks.push_back(track);
  }
  IndexTracks(scene);
  return scene;
}

double DistanceOf(const Scene& scene, const Scene& truth, int photo) {
  return (scene.photos[photo].pose->Center() - truth.photos[photo].pose->Center()).norm();
}

// Moves the keypoints of a photo, but for the first `kept`, to random places.
void Spoil(int photo, size_t kept, Scene& scene) {
  Random random(7);
  std::vector<Eigen::Vector2d>& keypoints = scene.photos[photo].keypoints;
  for (size_t i = kept; i < keypoints.size(); ++i) {
    keypoints[i] = {random.Uniform(0, 1200), random.Uniform(0, 900)};
  }
}

TEST(PlaceInModel, FindsExactPosesAndLeavesPoints) {
  const Scene truth = MakeScene({});
  Scene scene = NewPhotos(truth, 3);
  const std::vector<SceneTrack> points = scene.tracks;
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  ASSERT_EQ(placed.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    EXPECT_THAT(placed[i].why, IsEmpty());
    EXPECT_EQ(placed[i].num_inliers, placed[i].num_points);
    ASSERT_TRUE(scene.photos[i].pose);
    EXPECT_LT(DistanceOf(scene, truth, i), 1e-4);
  }
  for (size_t t = 0; t < points.size(); ++t) {
    EXPECT_EQ(*points[t].position, *scene.tracks[t].position);
  }
  EXPECT_EQ(scene.cameras[0].intrinsics.params, truth.cameras[0].intrinsics.params);
}

TEST(PlaceInModel, OneNoisyPhotoIsAsSureAsItSays) {
  const Scene truth = MakeScene({.noise_px = 1});
  Scene scene = NewPhotos(truth, 1);
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  ASSERT_TRUE(scene.photos[0].pose) << placed[0].why;
  EXPECT_GT(placed[0].sigma.position, 1e-4);
  EXPECT_LT(DistanceOf(scene, truth, 0), 4 * placed[0].sigma.position);
  EXPECT_GT(placed[0].sigma.picture_px, 0.01);
  EXPECT_LT(placed[0].sigma.picture_px, 0.5);
}

TEST(PlaceInModel, FindsTheFocalLengthOfACameraThatNobodyKnows) {
  const Scene truth = MakeScene({.num_points = 500, .num_planes = 3, .noise_px = 0.5});
  Scene scene = NewPhotos(truth, 2);
  SceneCamera& camera = scene.cameras[0];
  camera.focal_sigma_ratio = 0.5;
  camera.prior.params = {1500, 1500, 600, 450, 0, 0, 0, 0};
  camera.intrinsics.params = camera.prior.params;
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  ASSERT_TRUE(scene.photos[0].pose) << placed[0].why;
  EXPECT_NEAR(camera.intrinsics.params[0] / truth.cameras[0].intrinsics.params[0], 1, 0.02);
  EXPECT_LT(DistanceOf(scene, truth, 0), 0.3);
}

// The drone is of the model that the survey knows, but not the same one.
TEST(PlaceInModel, LetsAKnownLensGoThatIsAnotherBodys) {
  const Scene truth = MakeScene({.num_points = 500, .num_planes = 3, .noise_px = 0.5});
  Scene scene = NewPhotos(truth, 3);
  for (Camera* lens : {&scene.cameras[0].intrinsics, &scene.cameras[0].prior}) {
    lens->params[0] *= 1.012;
    lens->params[1] *= 1.012;
    lens->params[2] += 6;
    lens->params[4] += 0.01;
  }
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  for (int i = 0; i < 3; ++i) {
    ASSERT_TRUE(scene.photos[i].pose) << placed[i].why;
    EXPECT_LT(DistanceOf(scene, truth, i), 0.05);
    EXPECT_LT(placed[i].sigma.picture_px, 0.5);
  }
  const double ratio =
      scene.cameras[0].intrinsics.params[0] / truth.cameras[0].intrinsics.params[0];
  EXPECT_NEAR(ratio, 1, 0.002);
}

TEST(PlaceInModel, HoldsAKnownLensThatFits) {
  const Scene truth = MakeScene({.num_points = 500, .num_planes = 3, .noise_px = 1});
  Scene scene = NewPhotos(truth, 3);
  PlaceInModel(scene);
  EXPECT_EQ(scene.cameras[0].intrinsics.params, truth.cameras[0].intrinsics.params);
  EXPECT_EQ(scene.cameras[0].focal_sigma_ratio, 0);
}

TEST(PlaceInModel, ForeignPhotoGetsNoPoseAndHarmsNoOther) {
  const Scene truth = MakeScene({});
  Scene scene = NewPhotos(truth, 2);
  scene.cameras[0].focal_sigma_ratio = 0.1;  // shared by both, and variable
  Spoil(1, 0, scene);
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  EXPECT_FALSE(scene.photos[1].pose);
  EXPECT_THAT(placed[1].why, HasSubstr("no more than chance lets"));
  ASSERT_TRUE(scene.photos[0].pose);
  EXPECT_LT(DistanceOf(scene, truth, 0), 0.01);
}

TEST(PlaceInModel, FewPointsAreTooFew) {
  const Scene truth = MakeScene({});
  Scene scene = NewPhotos(truth, 1);
  scene.tracks.resize(12);
  IndexTracks(scene);
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  EXPECT_FALSE(scene.photos[0].pose);
  EXPECT_THAT(placed[0].why, HasSubstr("only 12 of its details"));
}

TEST(PlaceInModel, UncertainPoseIsRefused) {
  const Scene truth = MakeScene({.seen_share = 1, .noise_px = 2});
  Scene scene = NewPhotos(truth, 1);
  scene.tracks.resize(22);  // just enough of them to be above chance
  IndexTracks(scene);
  const std::vector<PlacedPhoto> placed = PlaceInModel(scene);
  EXPECT_FALSE(scene.photos[0].pose);
  EXPECT_THAT(placed[0].why, HasSubstr("is good to"));
  EXPECT_GT(placed[0].sigma.picture_px, 1);
}

}  // namespace
}  // namespace stucco::test
