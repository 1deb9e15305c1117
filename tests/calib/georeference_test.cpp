// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/georeference.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

Similarity MadeSimilarity() {
  Similarity s;
  s.scale = 7.5;
  s.rotation = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, -1, 0.4).normalized());
  s.translation = {120, -40, 15};
  return s;
}

// Poses in a frame of their own; priors are the centres in ENU with noise.
Scene SceneWithPriors(int photos, double sigma_m) {
  Scene scene = MakeScene({.num_photos = photos, .num_points = 30, .arc_rad = 2});
  Random random(21);
  for (ScenePhoto& photo : scene.photos) {
    const Eigen::Vector3d noise(random.Gauss(sigma_m), random.Gauss(sigma_m),
                                random.Gauss(sigma_m));
    photo.prior = PositionPrior{MadeSimilarity() * photo.pose->Center() + noise,
                                std::max(0.01, sigma_m), std::max(0.01, sigma_m)};
  }
  return scene;
}

void ExpectSimilar(const Similarity& actual, double limit_m) {
  const Similarity expected = MadeSimilarity();
  for (const Eigen::Vector3d& p :
       {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(10, -15, 3), Eigen::Vector3d(-10, -15, 5)}) {
    EXPECT_LT((actual * p - expected * p).norm(), limit_m);
  }
}

TEST(FitToPriors, RecoversExactFrame) {
  const auto fit = FitToPriors(SceneWithPriors(10, 0), {});
  ASSERT_TRUE(fit);
  ExpectSimilar(fit->enu_from_scene, 1e-6);
  EXPECT_TRUE(fit->outliers.empty());
  EXPECT_GT(fit->spread_m, 10);
}

TEST(FitToPriors, AveragesNoise) {
  const auto fit = FitToPriors(SceneWithPriors(20, 2), {});
  ASSERT_TRUE(fit);
  ExpectSimilar(fit->enu_from_scene, 6);
  EXPECT_TRUE(fit->outliers.empty());
}

TEST(FitToPriors, FindsWrongPositions) {
  Scene scene = SceneWithPriors(12, 0.05);
  scene.photos[3].prior->position.x() += 8;
  scene.photos[7].prior->position.z() -= 12;
  const auto fit = FitToPriors(scene, {});
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->outliers, (std::vector<int>{3, 7}));
  ExpectSimilar(fit->enu_from_scene, 0.3);
}

TEST(FitToPriors, RefusesPositionsThatContradictEachOther) {
  Scene scene = SceneWithPriors(12, 0.02);
  Random random(2);
  for (ScenePhoto& photo : scene.photos) photo.prior->position = random.Vector(100);
  EXPECT_FALSE(FitToPriors(scene, {}));
}

// Twenty metres between photos on a line, with `sigma_m` of noise in what was recorded.
Scene OneLine(double sigma_m) {
  Scene scene = SceneWithPriors(10, 0.02);
  Random random(4);
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    Pose& pose = *scene.photos[i].pose;
    const double sway = i % 2 == 0 ? 0.02 : -0.02;
    pose.translation = -(pose.rotation * Eigen::Vector3d(2.0 * i, sway, 0.5 * sway));
    scene.photos[i].prior->sigma_horizontal_m = std::max(0.02, sigma_m);
    scene.photos[i].prior->sigma_vertical_m = std::max(0.02, sigma_m);
    scene.photos[i].prior->position =
        Eigen::Vector3d(0, 20.0 * i, 0) +
        Eigen::Vector3d(random.Gauss(sigma_m), random.Gauss(sigma_m), random.Gauss(sigma_m));
  }
  return scene;
}

TEST(FitToPriors, TakesOnlyTheScaleFromOneLine) {
  for (const double sigma_m : {0.5, 2.0}) {
    const auto fit = FitToPriors(OneLine(sigma_m), {});
    ASSERT_TRUE(fit);
    EXPECT_EQ(fit->holds, FitHolds::kScale);
    EXPECT_NEAR(fit->enu_from_scene.scale, 10, 0.2);
  }
}

TEST(FitToPriors, TakesUpFromElsewhereOnOneLine) {
  const Eigen::Vector3d up = Eigen::Vector3d(0, 0.6, 0.8);
  const auto fit = FitToPriors(OneLine(0.5), up);
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->holds, FitHolds::kScaleAndHeading);
  EXPECT_NEAR(fit->enu_from_scene.scale, 10, 0.2);
  EXPECT_NEAR((fit->enu_from_scene.rotation * up).z(), 1, 1e-12);
  // The line runs north.
  EXPECT_GT((fit->enu_from_scene.rotation * Eigen::Vector3d::UnitX()).y(), 0.999);
  EXPECT_TRUE(fit->outliers.empty());
}

TEST(FitToPriors, HoldsEverythingWhereTheCamerasSpread) {
  const auto fit = FitToPriors(SceneWithPriors(20, 1), Eigen::Vector3d(0, 1, 0));
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->holds, FitHolds::kEverything);
}

TEST(FitToPriors, RefusesPositionsCloserThanTheirAccuracy) {
  EXPECT_FALSE(FitToPriors(SceneWithPriors(10, 500), {}));
  Scene scene = SceneWithPriors(10, 0);
  for (ScenePhoto& photo : scene.photos) photo.prior->position = {1, 2, 3};
  EXPECT_FALSE(FitToPriors(scene, {}));
}

// The stated accuracy of a drone's GPS is that of the absolute position.
TEST(FitToPriors, BelievesPositionsThatAgree) {
  Scene scene = SceneWithPriors(10, 0.3);
  for (ScenePhoto& photo : scene.photos) photo.prior->sigma_horizontal_m = 20;
  const auto fit = FitToPriors(scene, {});
  ASSERT_TRUE(fit);
  EXPECT_EQ(fit->holds, FitHolds::kEverything);
}

TEST(FitToPriors, NeedsThreePositions) {
  Scene scene = SceneWithPriors(6, 0);
  for (const int i : {0, 2, 3, 5}) scene.photos[i].prior.reset();
  EXPECT_FALSE(FitToPriors(scene, {}));
  scene.photos[1].pose.reset();
  EXPECT_FALSE(FitToPriors(scene, {}));
  EXPECT_FALSE(FitToPriors(Scene{}, {}));
}

TEST(FitToPriors, IsRepeatable) {
  const Scene scene = SceneWithPriors(12, 1);
  const auto first = FitToPriors(scene, {});
  const auto second = FitToPriors(scene, {});
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->enu_from_scene.translation, second->enu_from_scene.translation);
}

CapturedPhoto At(double latitude, double longitude, double height) {
  CapturedPhoto photo;
  photo.position = GeoPosition{latitude, longitude, height, true, 3, 6, false};
  return photo;
}

std::vector<const CapturedPhoto*> Pointers(const std::vector<CapturedPhoto>& photos) {
  std::vector<const CapturedPhoto*> pointers;
  for (const CapturedPhoto& photo : photos) pointers.push_back(&photo);
  return pointers;
}

TEST(FrameFromPositions, PutsTheOriginInTheMiddle) {
  std::vector<CapturedPhoto> photos = {At(45, 7, 300), At(45.001, 7.001, 310),
                                       At(45.002, 7.002, 320), CapturedPhoto{}};
  Scene scene;
  scene.photos.resize(4);
  const auto frame = FrameFromPositions(Pointers(photos), scene);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->frame, "enu");
  EXPECT_EQ(frame->source, "gps");
  EXPECT_TRUE(frame->metric);
  EXPECT_NEAR(frame->origin_latitude_deg, 45.001, 1e-12);
  EXPECT_NEAR(frame->origin_longitude_deg, 7.001, 1e-12);
  EXPECT_NEAR(frame->origin_height_m, 310, 1e-9);
  ASSERT_TRUE(scene.photos[2].prior);
  // A thousandth of a degree: 111.1 m north, 78.8 m east at this latitude.
  EXPECT_NEAR(scene.photos[2].prior->position.y(), 111.1, 0.2);
  EXPECT_NEAR(scene.photos[2].prior->position.x(), 78.8, 0.2);
  EXPECT_NEAR(scene.photos[2].prior->position.z(), 10, 0.01);
  EXPECT_EQ(scene.photos[2].prior->sigma_horizontal_m, 3);
  EXPECT_EQ(scene.photos[2].prior->sigma_vertical_m, 6);
  EXPECT_FALSE(scene.photos[3].prior);
}

TEST(FrameFromPositions, KnowsRtk) {
  std::vector<CapturedPhoto> photos = {At(45, 7, 300), At(45.001, 7, 310), At(45, 7.002, 320)};
  photos[0].position->rtk_fixed = photos[2].position->rtk_fixed = true;
  Scene scene;
  scene.photos.resize(3);
  EXPECT_EQ(FrameFromPositions(Pointers(photos), scene)->source, "rtk");
}

TEST(FrameFromPositions, NeedsThreePositionsWithHeights) {
  std::vector<CapturedPhoto> photos = {At(45, 7, 300), At(45.001, 7, 310), At(45, 7.002, 320)};
  photos[1].position->has_height = false;
  Scene scene;
  scene.photos.resize(3);
  EXPECT_FALSE(FrameFromPositions(Pointers(photos), scene));
  EXPECT_FALSE(scene.photos[0].prior);
}

TEST(FrameFromPlan, PutsPhotosWhereTheyArePlanned) {
  PlanOrigin origin;
  origin.latitude_deg = 50;
  origin.longitude_deg = 14;
  origin.height_m = 200;
  std::vector<std::optional<Pose>> expected(4);
  for (int i = 0; i < 3; ++i) {
    const Eigen::Vector3d center(100.0 * i, -50, 30);
    const Eigen::Quaterniond rotation(Eigen::AngleAxisd(0.3 * i, Eigen::Vector3d::UnitX()));
    expected[i] = Pose{rotation, -(rotation * center)};
  }
  Scene scene;
  scene.photos.resize(4);
  const auto frame = FrameFromPlan(origin, expected, scene);
  ASSERT_TRUE(frame);
  EXPECT_EQ(frame->source, "plan");
  EXPECT_TRUE(frame->metric);
  EXPECT_DOUBLE_EQ(frame->origin_latitude_deg, 50);
  EXPECT_DOUBLE_EQ(frame->origin_height_m, 200);
  ASSERT_TRUE(scene.photos[2].prior);
  EXPECT_LT((scene.photos[2].prior->position - Eigen::Vector3d(200, -50, 30)).norm(), 0.01);
  EXPECT_FALSE(scene.photos[3].prior);
  expected[0].reset();
  EXPECT_FALSE(FrameFromPlan(origin, expected, scene));
}

TEST(TransformScene, KeepsReprojectionErrors) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 40});
  scene.photos[3].pose.reset();
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& e : track.elements) e.used = e.photo != 3;
  }
  Transform(MadeSimilarity(), scene);
  EXPECT_FALSE(scene.photos[3].pose);
  for (const SceneTrack& track : scene.tracks) {
    for (const SceneElement& e : track.elements) {
      if (e.used) {
        EXPECT_LT(ReprojectionError(scene, e, *track.position), 1e-8);
      }
    }
  }
}

// Gimbal angles of a pose in a frame where up is z.
GimbalAngles GimbalOf(const Pose& level_pose, double roll_deg) {
  const Eigen::Vector3d forward = level_pose.rotation.conjugate() * Eigen::Vector3d::UnitZ();
  return {std::atan2(forward.x(), forward.y()) * 180 / std::numbers::pi,
          std::asin(forward.z()) * 180 / std::numbers::pi, roll_deg};
}

struct GimbalCase {
  Scene scene;
  std::vector<CapturedPhoto> captures;
};

GimbalCase MakeGimbalCase(double roll_deg) {
  GimbalCase c{MakeScene({.num_photos = 6, .num_points = 30}), {}};
  for (ScenePhoto& photo : c.scene.photos) {
    CapturedPhoto capture;
    capture.gimbal = GimbalOf(*photo.pose, roll_deg);
    c.captures.push_back(capture);
    // Clockwise as the photographer sees it: x right turns towards y down.
    Pose rolled;
    rolled.rotation =
        Eigen::AngleAxisd(-roll_deg * std::numbers::pi / 180, Eigen::Vector3d::UnitZ());
    photo.pose = rolled * *photo.pose;
  }
  Transform(MadeSimilarity(), c.scene);
  return c;
}

TEST(UpFromGimbal, FindsUp) {
  for (const double roll_deg : {0.0, 12.0, -30.0}) {
    const GimbalCase c = MakeGimbalCase(roll_deg);
    const auto up = UpFromGimbal(Pointers(c.captures), c.scene);
    ASSERT_TRUE(up);
    EXPECT_LT((*up - MadeSimilarity().rotation * Eigen::Vector3d::UnitZ()).norm(), 1e-9);
  }
}

TEST(UpFromGimbal, WorksLookingStraightDown) {
  Scene scene;
  scene.photos.resize(3);
  CapturedPhoto down;
  down.gimbal = GimbalAngles{50, -90, 0};
  const std::vector<CapturedPhoto> captures(3, down);
  for (ScenePhoto& photo : scene.photos) {
    photo.pose =
        Pose{Eigen::Quaterniond(Eigen::AngleAxisd(std::numbers::pi, Eigen::Vector3d::UnitX())),
             {0, 0, 9}};
  }
  const auto up = UpFromGimbal(Pointers(captures), scene);
  ASSERT_TRUE(up);
  EXPECT_LT((*up - Eigen::Vector3d::UnitZ()).norm(), 1e-9);
}

TEST(UpFromGimbal, NothingWhenAnglesDisagreeOrLack) {
  GimbalCase c = MakeGimbalCase(0);
  for (size_t i = 0; i < c.captures.size(); ++i)
    c.captures[i].gimbal->pitch_deg += i % 2 ? 40 : -40;
  EXPECT_FALSE(UpFromGimbal(Pointers(c.captures), c.scene));
  c = MakeGimbalCase(0);
  for (size_t i = 1; i < c.captures.size(); ++i) c.captures[i].gimbal.reset();
  EXPECT_FALSE(UpFromGimbal(Pointers(c.captures), c.scene));
  c = MakeGimbalCase(0);
  EXPECT_FALSE(UpFromGimbal(Pointers(c.captures), Blank(c.scene)));
}

TEST(MeasurePriors, LeavesOutliersOut) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 30});
  for (int i = 0; i < 3; ++i) {
    scene.photos[i].prior =
        PositionPrior{scene.photos[i].pose->Center() + Eigen::Vector3d(3, 4, 12), 5, 10};
  }
  scene.photos[2].prior->position.x() += 1000;
  const PriorResiduals residuals = MeasurePriors(scene, {2});
  EXPECT_NEAR(residuals.rms_horizontal_m, 5, 1e-9);
  EXPECT_NEAR(residuals.rms_vertical_m, 12, 1e-9);
  ASSERT_EQ(residuals.distance_m.size(), 4u);
  EXPECT_NEAR(residuals.distance_m[0], 13, 1e-9);
  EXPECT_GT(residuals.distance_m[2], 900);
  EXPECT_EQ(residuals.distance_m[3], -1);
  EXPECT_EQ(MeasurePriors(Blank(scene), {}).rms_horizontal_m, -1);
}

}  // namespace
}  // namespace stucco::test
