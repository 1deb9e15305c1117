// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/covariance.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>

#include "calib/adjust/adjust.h"
#include "calib/records/georeference.h"
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
    const auto sigmas = EstimateSigmas({}, scene).intrinsics;
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
  const auto before = EstimateSigmas({}, scene).intrinsics;
  Similarity motion;
  motion.scale = 30;
  motion.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized());
  motion.translation = {500, -300, 20000};
  Transform(motion, scene);
  const auto after = EstimateSigmas({}, scene).intrinsics;
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
  const auto sigmas = EstimateSigmas({}, scene).intrinsics;
  ASSERT_EQ(sigmas.size(), 1u);
  EXPECT_GT(sigmas[0][0], 0.7 * PriorSigma(scene.cameras[0], 0));
  EXPECT_LT(sigmas[0][0], 1.01 * PriorSigma(scene.cameras[0], 0));
}

TEST(IntrinsicsSigma, ZeroForGivenCameras) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 80, .noise_px = 0.5});
  scene.cameras.push_back(scene.cameras[0]);
  scene.cameras[1].focal_sigma_ratio = 0;
  scene.photos[2].camera = scene.photos[3].camera = 1;
  const auto sigmas = EstimateSigmas({}, scene).intrinsics;
  ASSERT_EQ(sigmas.size(), 2u);
  EXPECT_GT(sigmas[0].minCoeff(), 0);
  EXPECT_EQ(sigmas[1].maxCoeff(), 0);
}

TEST(IntrinsicsSigma, NothingForTooFewOrTooManyPhotos) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 80, .noise_px = 0.5});
  EXPECT_TRUE(EstimateSigmas({.max_photos = 3}, scene).intrinsics.empty());
  EXPECT_FALSE(EstimateSigmas({.max_photos = 4}, scene).intrinsics.empty());
  EXPECT_TRUE(EstimateSigmas({}, Blank(scene)).intrinsics.empty());
}

// Distances of the centres after the best similarity, angles of the rotations, and distances of
// the true points in the pictures, root mean square.
struct PoseError {
  double position = 0;
  double rotation_rad = 0;
  double picture_px = 0;
};

double ErrorInPicture(const Scene& truth, const Scene& scene, int photo) {
  double squares = 0;
  const std::vector<int> tracks = TracksSeenBy(truth, photo);
  for (const int track : tracks) {
    const Eigen::Vector3d& point = *truth.tracks[track].position;
    const auto found = scene.CameraOf(photo).Project(*scene.photos[photo].pose * point);
    const auto real = truth.CameraOf(photo).Project(*truth.photos[photo].pose * point);
    squares += (*found - *real).squaredNorm();
  }
  return std::sqrt(squares / static_cast<double>(tracks.size()));
}

std::vector<PoseError> ErrorsAfterAlignment(const Scene& truth, Scene scene) {
  const auto count = static_cast<Eigen::Index>(scene.photos.size());
  Eigen::Matrix3Xd found(3, count), real(3, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    found.col(i) = scene.photos[i].pose->Center();
    real.col(i) = truth.photos[i].pose->Center();
  }
  Transform(AlignPoints(found, real), scene);
  std::vector<PoseError> errors;
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    const Pose& pose = *scene.photos[i].pose;
    errors.push_back({(pose.Center() - truth.photos[i].pose->Center()).norm(),
                      pose.rotation.angularDistance(truth.photos[i].pose->rotation),
                      ErrorInPicture(truth, scene, static_cast<int>(i))});
  }
  return errors;
}

TEST(PoseSigmas, AgreeWithRepeatedMeasurements) {
  constexpr int kRuns = 30;
  const Scene truth = MakeScene({.num_photos = 8, .num_points = 150, .num_planes = 3});
  const size_t count = truth.photos.size();
  std::vector<PoseError> squares(count), predicted(count);
  for (int run = 0; run < kRuns; ++run) {
    Scene scene = truth;
    DrawPrior(900 + run, scene);
    scene = Adjusted(scene, 300 + run);
    const SceneSigmas sigmas = EstimateSigmas({}, scene);
    const std::vector<PoseError> errors = ErrorsAfterAlignment(truth, scene);
    for (size_t i = 0; i < count; ++i) {
      squares[i].position += errors[i].position * errors[i].position / kRuns;
      squares[i].rotation_rad += errors[i].rotation_rad * errors[i].rotation_rad / kRuns;
      squares[i].picture_px += errors[i].picture_px * errors[i].picture_px / kRuns;
      predicted[i].picture_px += sigmas.poses[i].picture_px / kRuns;
      predicted[i].position += sigmas.poses[i].position / kRuns;
      predicted[i].rotation_rad += sigmas.poses[i].rotation_rad / kRuns;
    }
  }
  for (size_t i = 0; i < count; ++i) {
    EXPECT_NEAR(std::log(predicted[i].position / std::sqrt(squares[i].position)), 0, 0.4) << i;
    EXPECT_NEAR(std::log(predicted[i].rotation_rad / std::sqrt(squares[i].rotation_rad)), 0, 0.4)
        << i;
    EXPECT_NEAR(std::log(predicted[i].picture_px / std::sqrt(squares[i].picture_px)), 0, 0.4) << i;
  }
}

TEST(PoseSigmas, ScaleWithTheModelAndDoNotDependOnTheFrame) {
  Scene scene = Adjusted(MakeScene({.num_photos = 6, .num_points = 120, .num_planes = 3}), 1);
  const auto before = EstimateSigmas({}, scene).poses;
  Similarity motion;
  motion.scale = 30;
  motion.rotation = Eigen::AngleAxisd(1.0, Eigen::Vector3d(1, 2, 3).normalized());
  motion.translation = {500, -300, 2000};
  Transform(motion, scene);
  const auto after = EstimateSigmas({.threads = 2}, scene).poses;
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_NEAR(after[i].position / before[i].position, 30, 0.6) << i;
    EXPECT_NEAR(after[i].rotation_rad / before[i].rotation_rad, 1, 0.02) << i;
    EXPECT_NEAR(after[i].picture_px / before[i].picture_px, 1, 0.02) << i;
  }
}

// Photos that match the others worse than these match each other are known less surely than all
// residuals together say.
TEST(PoseSigmas, FollowTheResidualsOfThePhoto) {
  const Scene truth = MakeScene({.num_photos = 8, .num_points = 300, .num_planes = 3});
  constexpr int kRuns = 20;
  constexpr int kWorse = 3;
  double squares = 0;
  double predicted = 0;
  for (int run = 0; run < kRuns; ++run) {
    Scene scene = truth;
    AddNoise(700 + run, scene);
    Random random(50 + run);
    for (Eigen::Vector2d& keypoint : scene.photos[kWorse].keypoints) {
      keypoint += Eigen::Vector2d(random.Gauss(6 * kNoise), random.Gauss(6 * kNoise));
    }
    AdjustOptions options;
    options.refine = RefineIntrinsics::kNone;
    options.loss_scale = 2 * MeasureNoise(scene);
    options.tolerance = 1e-8;
    ASSERT_TRUE(Adjust(options, scene).usable);
    squares += std::pow(ErrorsAfterAlignment(truth, scene)[kWorse].position, 2) / kRuns;
    predicted += EstimateSigmas({}, scene).poses[kWorse].position / kRuns;
  }
  EXPECT_NEAR(std::log(predicted / std::sqrt(squares)), 0, 0.4);
}

// Records that are much better than what the photos tell among themselves make poses more certain.
TEST(PoseSigmas, GetSmallerByRecords) {
  Scene scene = Adjusted(MakeScene({.num_photos = 6, .num_points = 120, .num_planes = 3}), 1);
  const auto without = EstimateSigmas({}, scene).poses;
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    const double sigma = without[i].position / 20;
    scene.photos[i].prior = PositionPrior{scene.photos[i].pose->Center(), sigma, sigma};
  }
  const auto with = EstimateSigmas({.use_priors = true}, scene).poses;
  for (size_t i = 0; i < without.size(); ++i) EXPECT_LT(with[i].position, without[i].position / 5);
  EXPECT_DOUBLE_EQ(EstimateSigmas({}, scene).poses[0].position, without[0].position);
}

TEST(PoseSigmas, APhotoWithFewObservationsIsLessCertain) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 200, .num_planes = 3, .noise_px = 0.5});
  int left = 25;
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& element : track.elements) {
      if (element.photo == 3 && element.used && left-- <= 0) element.used = false;
    }
  }
  const auto sigmas = EstimateSigmas({}, scene).poses;
  for (const int other : {1, 2, 4}) EXPECT_GT(sigmas[3].position, 1.5 * sigmas[other].position);
}

TEST(PoseSigmas, APhotoThatShowsLargeBlobsIsLessCertain) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 200, .num_planes = 3, .noise_px = 0.5});
  for (ScenePhoto& photo : scene.photos) photo.blobs_px.assign(photo.keypoints.size(), 1);
  const auto before = EstimateSigmas({}, scene).poses;
  scene.photos[3].blobs_px.assign(scene.photos[3].keypoints.size(), 30);
  const auto after = EstimateSigmas({}, scene).poses;
  EXPECT_GT(after[3].position, 3 * before[3].position);
  EXPECT_LT(after[2].position, 2 * before[2].position);
}

// One photo that its points hardly hold makes the equations of all singular.
TEST(PoseSigmas, APhotoThatNothingHoldsLeavesThoseOfTheOthers) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 200, .num_planes = 3, .noise_px = 0.5});
  const auto before = EstimateSigmas({}, scene).poses;
  int left = 2;
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& element : track.elements) {
      if (element.photo == 5 && element.used && left-- <= 0) element.used = false;
    }
  }
  const auto after = EstimateSigmas({}, scene).poses;
  for (int i = 0; i < 5; ++i) {
    EXPECT_GT(after[i].position, 0.5 * before[i].position) << i;
    EXPECT_LT(after[i].position, 3 * before[i].position) << i;
  }
  EXPECT_TRUE(after[5].position < 0 || after[5].position > 20 * before[5].position);
}

// What two photos from nearly one place share alone has no depth, and may end up right before both
// lenses, where any shift moves it without limit.
TEST(PoseSigmas, PointsRightBeforeTheLensDoNotMoveThePicture) {
  Scene scene = MakeScene({.num_photos = 6, .num_points = 200, .num_planes = 3, .noise_px = 0.5});
  const auto before = EstimateSigmas({}, scene).poses;
  SceneTrack& track = scene.tracks[TracksSeenBy(scene, 3)[0]];
  const Eigen::Vector3d centre = scene.photos[3].pose->Center();
  track.position = centre + 1e-7 * (*track.position - centre);
  const auto after = EstimateSigmas({}, scene).poses;
  EXPECT_GT(after[3].picture_px, 0.5 * before[3].picture_px);
  EXPECT_LT(after[3].picture_px, 2 * before[3].picture_px);
}

TEST(PoseSigmas, NoneWithoutAPose) {
  Scene scene = MakeScene({.num_photos = 5, .num_points = 120, .noise_px = 0.5});
  scene.photos[2].pose.reset();
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& element : track.elements) element.used &= element.photo != 2;
  }
  for (const int max_photos : {3, 10}) {
    const auto sigmas = EstimateSigmas({.max_photos = max_photos}, scene).poses;
    ASSERT_EQ(sigmas.size(), 5u);
    EXPECT_EQ(sigmas[2].position, -1);
    EXPECT_GT(sigmas[1].position, 0);
  }
}

}  // namespace
}  // namespace stucco::test
