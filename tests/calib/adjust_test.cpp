// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/adjust.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "survey/error.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

// Moves all poses but the first, and all points, from where they should be.
void Disturb(double angle_rad, double offset, Scene& scene) {
  Random random(11);
  for (size_t i = 1; i < scene.photos.size(); ++i) {
    scene.photos[i].pose = Disturbed(*scene.photos[i].pose, angle_rad, offset, random);
  }
  for (SceneTrack& track : scene.tracks) *track.position += random.Vector(offset);
}

AdjustOptions Tight(RefineIntrinsics refine) {
  AdjustOptions options;
  options.refine = refine;
  options.max_iterations = 200;
  options.tolerance = 1e-14;
  return options;
}

TEST(Adjust, RecoversCleanScenes) {
  for (const CameraModel model :
       {CameraModel::kPinhole, CameraModel::kOpenCv, CameraModel::kFullOpenCv}) {
    const Scene truth = MakeScene({.num_points = 120, .model = model});
    Scene scene = truth;
    Disturb(0.002, 0.03, scene);
    const AdjustReport report = Adjust(Tight(RefineIntrinsics::kNone), scene);
    ASSERT_TRUE(report.usable);
    EXPECT_LT(report.rms_after, 1e-6);
    const PoseErrors errors = ComparePoses(scene, truth);
    EXPECT_LT(errors.position_m, 1e-6);
    EXPECT_LT(errors.rotation_rad, 1e-7);
  }
}

TEST(Adjust, RecoversIntrinsics) {
  const Scene truth = MakeScene({.num_points = 200});
  Scene scene = truth;
  Disturb(0.001, 0.02, scene);
  // The plausible values are the true ones here, so that they pull nowhere else.
  std::vector<double>& params = scene.cameras[0].intrinsics.params;
  params = {1030, 1031, 590, 455, -0.05, 0, 0, 0};
  const AdjustReport report = Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene);
  ASSERT_TRUE(report.usable);
  const std::vector<double>& expected = truth.cameras[0].intrinsics.params;
  for (size_t i = 0; i < params.size(); ++i) {
    EXPECT_NEAR(params[i], expected[i], i < 4 ? 1e-3 : 1e-6) << i;
  }
  EXPECT_LT(ComparePoses(scene, truth).position_m, 1e-6);
}

TEST(Adjust, FollowsThePhotosNotAWrongPrior) {
  const Scene truth = MakeScene({.num_points = 300, .noise_px = 0.3});
  Scene scene = truth;
  for (Camera* camera : {&scene.cameras[0].intrinsics, &scene.cameras[0].prior}) {
    camera->params = {950, 950, 600, 450, 0, 0, 0, 0};
  }
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene).usable);
  EXPECT_NEAR(scene.cameras[0].intrinsics.params[0], 1000, 3);
  EXPECT_NEAR(scene.cameras[0].intrinsics.params[4], -0.08, 0.01);
  EXPECT_LT(ComparePoses(scene, truth).position_m, 0.03);
}

TEST(Adjust, StaysWithinNoise) {
  const Scene truth = MakeScene({.num_points = 300, .noise_px = 0.5});
  Scene scene = truth;
  Disturb(0.002, 0.03, scene);
  const AdjustReport report = Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene);
  ASSERT_TRUE(report.usable);
  // Noise of 0.5 in both axes, less what the unknowns take up.
  EXPECT_GT(report.rms_after, 0.4);
  EXPECT_LT(report.rms_after, 0.75);
  EXPECT_LT(ComparePoses(scene, truth).position_m, 0.03);
}

// Every third keypoint is of a large blob and as much less sure.
Scene WithLargeBlobs(Scene scene) {
  Random random(5);
  for (ScenePhoto& photo : scene.photos) {
    photo.blobs_px.assign(photo.keypoints.size(), 1);
    for (size_t k = 0; k < photo.keypoints.size(); k += 3) photo.blobs_px[k] = 30;
    for (size_t k = 0; k < photo.keypoints.size(); ++k) {
      const double sigma = 0.2 * photo.KeypointSigma(static_cast<int>(k));
      photo.keypoints[k] += Eigen::Vector2d(random.Gauss(sigma), random.Gauss(sigma));
    }
  }
  return scene;
}

TEST(Adjust, LargeBlobsWeighLess) {
  const Scene truth = MakeScene({.num_points = 300});
  Scene weighed = WithLargeBlobs(truth);
  EXPECT_NEAR(MeasureNoise(weighed), 0.2, 0.02);
  Scene as_sharp = weighed;
  for (ScenePhoto& photo : as_sharp.photos) photo.blobs_px.clear();
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kNone), weighed).usable);
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kNone), as_sharp).usable);
  EXPECT_LT(ComparePoses(weighed, truth).position_m,
            0.6 * ComparePoses(as_sharp, truth).position_m);
}

TEST(Adjust, OutliersHardlyPull) {
  const Scene truth = MakeScene({.num_points = 300, .noise_px = 0.3});
  Scene scene = truth;
  Random random(3);
  for (ScenePhoto& photo : scene.photos) {
    for (Eigen::Vector2d& keypoint : photo.keypoints) {
      if (random.Uniform(0, 1) < 0.05) keypoint += Eigen::Vector2d(random.Gauss(15), 20);
    }
  }
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kNone), scene).usable);
  EXPECT_LT(ComparePoses(scene, truth).position_m, 0.05);
}

TEST(Adjust, LevelsOfIntrinsicsChangeOnlyTheirOwn) {
  const Scene truth =
      MakeScene({.num_points = 100, .noise_px = 1, .model = CameraModel::kFullOpenCv});
  const std::vector<double>& before = truth.cameras[0].intrinsics.params;
  const auto changed = [&](RefineIntrinsics level) {
    Scene scene = truth;
    EXPECT_TRUE(Adjust(Tight(level), scene).usable);
    std::string result;
    for (size_t i = 0; i < before.size(); ++i) {
      result += scene.cameras[0].intrinsics.params[i] != before[i] ? '+' : '-';
    }
    return result;
  };
  // fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6
  EXPECT_EQ(changed(RefineIntrinsics::kNone), "------------");
  EXPECT_EQ(changed(RefineIntrinsics::kFocal), "++----------");
  EXPECT_EQ(changed(RefineIntrinsics::kDistortion), "++--++--++++");
  EXPECT_EQ(changed(RefineIntrinsics::kPrincipalPoint), "++++++++++++");
}

TEST(Adjust, TakesLessFromFewPhotos) {
  Scene scene = MakeScene({.num_photos = 8, .num_points = 200});
  scene.cameras.push_back(scene.cameras[0]);
  scene.cameras[1].intrinsics.id = CameraId{2};
  for (const int photo : {6, 7}) scene.photos[photo].camera = 1;
  for (SceneCamera& camera : scene.cameras) {
    camera.intrinsics.params = {1030, 1030, 600, 450, 0, 0, 0, 0};
    camera.prior = camera.intrinsics;
  }
  const std::vector<double> before = scene.cameras[1].intrinsics.params;
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene).usable);
  EXPECT_EQ(scene.cameras[1].intrinsics.params, before);
  for (size_t i = 0; i < before.size(); ++i) {
    EXPECT_NE(scene.cameras[0].intrinsics.params[i], before[i]) << i;
  }
}

TEST(MeasureNoise, IgnoresWrongMatches) {
  Scene scene = MakeScene({.num_photos = 8, .num_points = 400, .noise_px = 0.4});
  EXPECT_NEAR(MeasureNoise(scene), 0.4, 0.03);
  Random random(3);
  for (ScenePhoto& photo : scene.photos) {
    for (size_t k = 0; k < photo.keypoints.size(); k += 8) photo.keypoints[k].x() += 50;
  }
  EXPECT_NEAR(MeasureNoise(scene), 0.45, 0.05);
  for (ScenePhoto& photo : scene.photos) photo.keypoint_sigma_px = 2;
  EXPECT_NEAR(MeasureNoise(scene), 0.225, 0.025);
}

TEST(MeasureNoise, HasALimitAndADefault) {
  EXPECT_EQ(MeasureNoise(MakeScene({.num_photos = 4})), 0.05);
  EXPECT_EQ(MeasureNoise(Scene{}), 1);
}

TEST(Adjust, LeavesGivenCamerasAlone) {
  Scene scene = MakeScene({.num_points = 100, .noise_px = 1});
  scene.cameras[0].focal_sigma_ratio = 0;
  const std::vector<double> before = scene.cameras[0].intrinsics.params;
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene).usable);
  EXPECT_EQ(scene.cameras[0].intrinsics.params, before);
}

TEST(Adjust, KeepsWhatThePhotosDoNotTell) {
  // One plane, seen head-on by cameras side by side: depth and focal length go together.
  Scene scene = MakeScene({.num_photos = 2,
                           .num_points = 60,
                           .num_planes = 1,
                           .clutter_share = 0,
                           .arc_rad = 0.1,
                           .noise_px = 0.3});
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kPrincipalPoint), scene).usable);
  const std::vector<double>& params = scene.cameras[0].intrinsics.params;
  EXPECT_NEAR(params[0], 1000, 150);
  EXPECT_NEAR(params[1] / params[0], 1.001, 0.01);
  EXPECT_NEAR(params[2], 604, 60);
}

TEST(Adjust, MovesOnlyVariablePhotos) {
  const Scene truth = MakeScene({.num_points = 150});
  Scene scene = truth;
  Random random(5);
  scene.photos[6].pose = Disturbed(*scene.photos[6].pose, 0.01, 0.1, random);
  AdjustOptions options = Tight(RefineIntrinsics::kNone);
  options.variable_photos = {6};
  ASSERT_TRUE(Adjust(options, scene).usable);
  for (int i = 0; i < 8; ++i) {
    const Pose& pose = *scene.photos[i].pose;
    const Pose& expected = *truth.photos[i].pose;
    if (i != 6) {
      EXPECT_EQ(pose.translation, expected.translation);
    }
    EXPECT_LT((pose.Center() - expected.Center()).norm(), 1e-6);
  }
}

TEST(Adjust, HoldsTheFrameWithoutPriors) {
  const Scene truth = MakeScene({.num_points = 150, .noise_px = 0.5});
  Scene scene = truth;
  ASSERT_TRUE(Adjust(Tight(RefineIntrinsics::kDistortion), scene).usable);
  EXPECT_EQ(scene.photos[0].pose->translation, truth.photos[0].pose->translation);
  // The scale has not drifted either.
  const double length = (scene.photos[7].pose->Center() - scene.photos[0].pose->Center()).norm();
  const double expected = (truth.photos[7].pose->Center() - truth.photos[0].pose->Center()).norm();
  EXPECT_NEAR(length / expected, 1, 0.01);
}

TEST(Adjust, PositionsGiveTheFrame) {
  const Scene truth = MakeScene({.num_points = 150, .noise_px = 0.3});
  Scene scene = truth;
  Random random(9);
  for (ScenePhoto& photo : scene.photos) {
    photo.prior = PositionPrior{photo.pose->Center(), 0.02, 0.03};
  }
  // A wrong scale, a turn and a shift, as after a rough alignment.
  Similarity motion;
  motion.scale = 1.02;
  motion.rotation = Eigen::AngleAxisd(0.01, Eigen::Vector3d(0.3, 1, 0.5).normalized());
  motion.translation = {0.2, -0.1, 0.3};
  for (ScenePhoto& photo : scene.photos) photo.pose = Transformed(*photo.pose, motion);
  for (SceneTrack& track : scene.tracks) track.position = motion * *track.position;
  AdjustOptions options = Tight(RefineIntrinsics::kNone);
  options.use_priors = true;
  ASSERT_TRUE(Adjust(options, scene).usable);
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    EXPECT_LT((scene.photos[i].pose->Center() - truth.photos[i].pose->Center()).norm(), 0.02);
  }
}

// Control points and positions that are all off together, as good as the points themselves.
TEST(Adjust, ControlPointsGiveTheFrameAndTheShiftOfPositions) {
  const Eigen::Vector3d shift(5, -3, 40);
  const Scene truth = MakeScene({.num_points = 150, .noise_px = 0.3});
  Scene scene = truth;
  for (ScenePhoto& photo : scene.photos) {
    photo.prior = PositionPrior{photo.pose->Center() + shift, 0.02, 0.02};
  }
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(-6, 1.75, 1), Eigen::Vector3d(6, 1.75, 1),
                                        Eigen::Vector3d(0, -2, 6), Eigen::Vector3d(0, -6, 0)}) {
    ControlPoint point{corner, {0.02, 0.02, 0.03}, {}, corner};
    for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
      const auto pixel = scene.CameraOf(i).Project(*scene.photos[i].pose * corner);
      if (pixel) point.marks.push_back({i, *pixel});
    }
    scene.control.points.push_back(point);
  }
  Similarity motion;
  motion.scale = 1.02;
  motion.rotation = Eigen::AngleAxisd(0.01, Eigen::Vector3d(0.3, 1, 0.5).normalized());
  motion.translation = {0.2, -0.1, 0.3};
  for (ScenePhoto& photo : scene.photos) photo.pose = Transformed(*photo.pose, motion);
  for (SceneTrack& track : scene.tracks) track.position = motion * *track.position;
  const Scene start = scene;
  AdjustOptions options = Tight(RefineIntrinsics::kNone);
  options.use_priors = true;
  ASSERT_TRUE(Adjust(options, scene).usable);
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    EXPECT_LT((scene.photos[i].pose->Center() - truth.photos[i].pose->Center()).norm(), 0.02);
  }
  EXPECT_LT((scene.control.positions_shift_m - shift).norm(), 0.02);
  // Without positions there is no shift, and points alone hold the frame.
  scene = start;
  for (ScenePhoto& photo : scene.photos) photo.prior.reset();
  ASSERT_TRUE(Adjust(options, scene).usable);
  EXPECT_EQ(scene.control.positions_shift_m, Eigen::Vector3d::Zero());
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    EXPECT_LT((scene.photos[i].pose->Center() - truth.photos[i].pose->Center()).norm(), 0.02);
  }
}

TEST(Adjust, SaysWhenThereIsNothingToDo) {
  Scene scene = Blank(MakeScene({.num_points = 50}));
  const AdjustReport report = Adjust({}, scene);
  EXPECT_FALSE(report.usable);
  EXPECT_EQ(report.num_observations, 0);
}

TEST(Adjust, RefusesOtherCameraModels) {
  Scene scene = MakeScene({.num_points = 50});
  scene.cameras[0].intrinsics.model = CameraModel::kSimpleRadial;
  EXPECT_THROW(Adjust({}, scene), Error);
}

TEST(Adjust, IsRepeatable) {
  const Scene truth = MakeScene({.num_points = 100, .noise_px = 0.5});
  Scene first = truth;
  Scene second = truth;
  Adjust({}, first);
  Adjust({}, second);
  EXPECT_EQ(first.cameras[0].intrinsics.params, second.cameras[0].intrinsics.params);
  EXPECT_EQ(first.photos[3].pose->rotation.coeffs(), second.photos[3].pose->rotation.coeffs());
  EXPECT_EQ(*first.tracks[5].position, *second.tracks[5].position);
}

}  // namespace
}  // namespace stucco::test
