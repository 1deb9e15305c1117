// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calib/adjust.h"
#include "calib/georeference.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

constexpr double kNoise = 0.5;  // half of what keypoints are taken for: the sigmas must notice

void AddNoise(uint32_t seed, Scene& scene) {
  Random random(seed);
  for (ScenePhoto& photo : scene.photos) {
    for (Eigen::Vector2d& keypoint : photo.keypoints) {
      keypoint += Eigen::Vector2d(random.Gauss(kNoise), random.Gauss(kNoise));
    }
  }
}

// The assumptions about the lens are as wrong as they say they may be.
void DrawPrior(uint32_t seed, Scene& scene) {
  Random random(seed);
  SceneCamera& camera = scene.cameras[0];
  const std::vector<double> truth = camera.prior.params;
  for (size_t i = 0; i < truth.size(); ++i) {
    camera.prior.params[i] += random.Gauss(PriorSigma(camera, static_cast<int>(i)));
  }
  const double ratio = truth[1] / truth[0] + random.Gauss(kFocalRatioSigma);
  camera.prior.params[1] = camera.prior.params[0] * ratio;
}

Scene Adjusted(Scene scene, uint32_t seed) {
  AddNoise(seed, scene);
  AdjustOptions options;
  options.refine = RefineIntrinsics::kPrincipalPoint;
  options.loss_scale = 10;
  options.tolerance = 1e-8;
  EXPECT_TRUE(Adjust(options, scene).usable);
  return scene;
}

TEST(IntrinsicsSigma, AgreesWithRepeatedMeasurements) {
  constexpr int kRuns = 40;
  const Scene truth = MakeScene({.num_photos = 6, .num_points = 120, .num_planes = 3});
  const size_t count = truth.cameras[0].intrinsics.params.size();
  std::vector<double> sum(count, 0), squares(count, 0), predicted(count, 0);
  for (int run = 0; run < kRuns; ++run) {
    Scene scene = truth;
    DrawPrior(500 + run, scene);
    scene = Adjusted(scene, 100 + run);
    const auto sigmas = IntrinsicsSigma(scene);
    ASSERT_EQ(sigmas.size(), 1u);
    for (size_t i = 0; i < count; ++i) {
      const double error =
          scene.cameras[0].intrinsics.params[i] - truth.cameras[0].intrinsics.params[i];
      sum[i] += error / kRuns;
      squares[i] += error * error / kRuns;
      predicted[i] += sigmas[0][i] / kRuns;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    const double spread = std::sqrt(squares[i] - sum[i] * sum[i]);
    EXPECT_LT(predicted[i] / spread, 1.5) << "parameter " << i;
    EXPECT_GT(predicted[i] / spread, 1 / 1.5) << "parameter " << i;
  }
}

TEST(IntrinsicsSigma, DoesNotDependOnTheFrame) {
  Scene scene = Adjusted(MakeScene({.num_photos = 6, .num_points = 120, .num_planes = 3}), 1);
  const auto before = IntrinsicsSigma(scene);
  Similarity motion;
  motion.scale = 30;
  motion.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized());
  motion.translation = {500, -300, 20000};
  Transform(motion, scene);
  const auto after = IntrinsicsSigma(scene);
  ASSERT_EQ(before.size(), 1u);
  ASSERT_EQ(after.size(), 1u);
  for (int i = 0; i < before[0].size(); ++i) EXPECT_NEAR(after[0][i] / before[0][i], 1, 0.02) << i;
}

TEST(IntrinsicsSigma, GrowsToTheAssumptionWhereThePhotosSayNothing) {
  // Two photos of one plane from nearly one place.
  const Scene scene = Adjusted(
      MakeScene(
          {.num_photos = 2, .num_points = 60, .num_planes = 1, .clutter_share = 0, .arc_rad = 0.1}),
      1);
  const auto sigmas = IntrinsicsSigma(scene);
  ASSERT_EQ(sigmas.size(), 1u);
  EXPECT_GT(sigmas[0][0], 0.7 * PriorSigma(scene.cameras[0], 0));
  EXPECT_LT(sigmas[0][0], 1.01 * PriorSigma(scene.cameras[0], 0));
}

TEST(IntrinsicsSigma, ZeroForGivenCameras) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 80, .noise_px = 0.5});
  scene.cameras.push_back(scene.cameras[0]);
  scene.cameras[1].focal_sigma_ratio = 0;
  scene.photos[2].camera = scene.photos[3].camera = 1;
  const auto sigmas = IntrinsicsSigma(scene);
  ASSERT_EQ(sigmas.size(), 2u);
  EXPECT_GT(sigmas[0].minCoeff(), 0);
  EXPECT_EQ(sigmas[1].maxCoeff(), 0);
}

TEST(IntrinsicsSigma, NothingForTooFewOrTooManyPhotos) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 80, .noise_px = 0.5});
  EXPECT_TRUE(IntrinsicsSigma(scene, 3).empty());
  EXPECT_FALSE(IntrinsicsSigma(scene, 4).empty());
  EXPECT_TRUE(IntrinsicsSigma(Blank(scene)).empty());
}

}  // namespace
}  // namespace stucco::test
