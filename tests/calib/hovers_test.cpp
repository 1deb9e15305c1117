// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/hovers.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "calib/adjust/adjust.h"
#include "calib/adjust/covariance.h"
#include "survey/attitude.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

Scene WithHovers() {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 200, .num_planes = 3, .noise_px = 0.3});
  for (const int photo : {0, 2, 4, 5}) scene.photos[photo].hover = 7;
  scene.photos[3].hover = 8;
  scene.photos[4].pose.reset();
  scene.hover_sigma_m = 0.1;
  return scene;
}

TEST(Hovers, PairPhotosThatHavePoses) {
  const std::vector<SamePlace> pairs = SamePlaces(WithHovers());
  ASSERT_EQ(pairs.size(), 3U);
  EXPECT_EQ(pairs[0].first, 0);
  EXPECT_EQ(pairs[0].second, 2);
  EXPECT_EQ(pairs[2].second, 5);
  for (const SamePlace& pair : pairs) EXPECT_NEAR(pair.sigma_m, 0.1 * std::sqrt(3.0), 1e-12);
}

TEST(Hovers, SayNothingWhereTheirScatterIsNotKnown) {
  Scene scene = WithHovers();
  scene.hover_sigma_m = 0;
  EXPECT_TRUE(SamePlaces(scene).empty());
}

TEST(Hovers, HaveMates) {
  const auto mates = HoverMates(WithHovers());
  EXPECT_EQ(mates[0], (std::vector{2, 5}));
  EXPECT_EQ(mates[4], (std::vector{0, 2, 5}));  // where it would stand
  EXPECT_TRUE(mates[1].empty() && mates[3].empty());
}

// Photo 3 was taken from the place of photo 2 and hangs on points in the middle of its picture
// alone, which tell hardly from how far they were seen.
class HangingPhoto : public ::testing::Test {
 protected:
  HangingPhoto() {
    scene_ = MakeScene({.num_photos = 6, .num_points = 1500, .num_planes = 3, .noise_px = 0.5});
    const Pose& other = *scene_.photos[2].pose;
    place_ = other.Center();
    const Eigen::Quaterniond turned = other.rotation * AboutUp(0.1);
    const Pose pose{turned, -(turned * place_)};
    scene_.photos[3].pose = pose;
    Random random(4);
    for (SceneTrack& track : scene_.tracks) {
      for (SceneElement& e : track.elements) {
        if (e.photo != 3) continue;
        const auto pixel = scene_.CameraOf(3).Project(pose * *track.position);
        e.used = pixel && (*pixel - Eigen::Vector2d(600, 450)).norm() < 45;
        if (!e.used) continue;
        scene_.photos[3].keypoints[e.keypoint] =
            *pixel + Eigen::Vector2d(random.Gauss(2), random.Gauss(2));
      }
    }
    for (ScenePhoto& photo : scene_.photos) {
      photo.prior = PositionPrior{photo.pose->Center(), 2, 2};
    }
    scene_.photos[3].prior->position += Eigen::Vector3d(1.5, -1, 0.5);
    options_.use_priors = true;
    options_.refine = RefineIntrinsics::kNone;
  }

  double Off() const { return (scene_.photos[3].pose->Center() - place_).norm(); }

  void LetHover(double sigma_m) {
    scene_.photos[2].hover = scene_.photos[3].hover = 1;
    scene_.hover_sigma_m = sigma_m;
  }

  Eigen::Vector3d place_;
  Scene scene_;
  AdjustOptions options_;
};

TEST_F(HangingPhoto, StandsWhereOthersOfItsHoverStand) {
  ASSERT_GT(NumUsedObservations(scene_, 3), 5);
  ASSERT_TRUE(Adjust(options_, scene_).usable);
  EXPECT_GT(Off(), 0.25);
  LetHover(0.02);
  ASSERT_TRUE(Adjust(options_, scene_).usable);
  EXPECT_LT(Off(), 0.1);
}

TEST_F(HangingPhoto, IsBroughtToThoseThatDoNotMove) {
  ASSERT_TRUE(Adjust(options_, scene_).usable);
  const Pose other = *scene_.photos[2].pose;
  LetHover(0.02);
  options_.variable_photos = {3};
  ASSERT_TRUE(Adjust(options_, scene_).usable);
  EXPECT_LT(Off(), 0.15);
  EXPECT_EQ(scene_.photos[2].pose->translation, other.translation);
}

TEST_F(HangingPhoto, IsSurerByItsHover) {
  const SigmaOptions with_priors{.use_priors = true};
  const auto alone = EstimateSigmas(with_priors, scene_).poses;
  LetHover(0.02);
  const auto beside = EstimateSigmas(with_priors, scene_).poses;
  EXPECT_LT(beside[3].position, 0.5 * alone[3].position);
  EXPECT_GT(beside[3].position, 0.02);
  // One that many points hold gains nothing.
  EXPECT_NEAR(beside[0].position, alone[0].position, 0.3 * alone[0].position);
  // Nor does any where records took no part.
  const double without = EstimateSigmas({}, scene_).poses[3].position;
  scene_.hover_sigma_m = 0;
  EXPECT_DOUBLE_EQ(EstimateSigmas({}, scene_).poses[3].position, without);
}

}  // namespace
}  // namespace stucco::test
