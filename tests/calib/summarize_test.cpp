// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/summarize.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

struct Case {
  Captures captures;
  std::vector<int> capture_of_photo;
  Scene scene;
  std::map<int, std::string> unregistered;
  PriorResiduals priors;
  std::vector<int> outliers;

  Calibration Summary() const {
    return Summarize({captures, capture_of_photo, scene, unregistered, priors, outliers, nullptr,
                      EstimateSigmas({}, scene)});
  }
};

// Four photos of a scene; the second capture was not usable, the last photo got no pose.
Case MakeCase() {
  Case c;
  c.scene = MakeScene({.num_photos = 4, .num_points = 200, .noise_px = 0.4});
  c.scene.photos[3].pose.reset();
  for (SceneTrack& track : c.scene.tracks) {
    int used = 0;
    for (SceneElement& e : track.elements) used += e.used = e.photo != 3;
    if (used < 2) {
      track.position.reset();
      for (SceneElement& e : track.elements) e.used = false;
    }
  }
  c.captures.cameras.push_back({"key", "Made 1200 x 900", c.scene.cameras[0].prior, "exif_35mm"});
  for (int i = 0; i < 5; ++i) {
    CapturedPhoto photo;
    photo.usable = i != 1;
    photo.path = photo.usable ? c.scene.photos[i > 1 ? i - 1 : i].name : "a/broken.jpg";
    photo.why = photo.usable ? "" : "the file ends early; copy it again";
    if (photo.usable) c.capture_of_photo.push_back(i);
    c.captures.photos.push_back(photo);
  }
  c.unregistered[3] = "it overlaps with no other photo";
  c.priors.distance_m = {0.5, 1.5, 30, -1};
  c.priors.rms_horizontal_m = 0.8;
  c.priors.rms_vertical_m = 0.9;
  c.outliers = {2};
  return c;
}

TEST(ToReconstruction, HoldsPosedPhotosAndTheirPoints) {
  const Case c = MakeCase();
  const Reconstruction r = ToReconstruction(c.scene, {1, 3, 4, 5});
  EXPECT_FALSE(FindProblem(r)) << *FindProblem(r);
  ASSERT_EQ(r.photos.size(), 3u);
  EXPECT_TRUE(r.photos.contains(PhotoId{4}));
  EXPECT_FALSE(r.photos.contains(PhotoId{5}));
  EXPECT_EQ(r.photos.at(PhotoId{3}).name, c.scene.photos[1].name);
  EXPECT_EQ(r.cameras.size(), 1u);
  size_t points = 0;
  for (const SceneTrack& track : c.scene.tracks) points += track.position.has_value();
  EXPECT_EQ(r.points.size(), points);
  for (const auto& [id, photo] : r.photos) {
    EXPECT_EQ(photo.observations.size(),
              static_cast<size_t>(NumUsedObservations(
                  c.scene, id.value == 1 ? 0 : static_cast<int>(id.value) - 2)));
  }
  // The error kept with each point is the mean over its own track.
  double sum = 0;
  size_t count = 0;
  for (const auto& [id, point] : r.points) {
    EXPECT_GE(point.track.size(), 2u);
    EXPECT_EQ(point.rgb[0], static_cast<int>(point.track[0].photo.value) -
                                (point.track[0].photo.value == 1 ? 1 : 2));
    sum += point.error_px * point.track.size();
    count += point.track.size();
  }
  EXPECT_NEAR(sum / count, MeanReprojectionError(r), 1e-9);
}

TEST(ToReconstruction, LeavesOutPointsThatLostTheirPhotos) {
  Case c = MakeCase();
  int spoiled = 0;
  for (SceneTrack& track : c.scene.tracks) {
    if (!track.position || spoiled == 2) continue;
    // One keeps a single observation, one none at all.
    int kept = spoiled++ == 0 ? 1 : 0;
    for (SceneElement& e : track.elements) e.used = e.used && kept-- > 0;
  }
  const Reconstruction r = ToReconstruction(c.scene, {1, 3, 4, 5});
  EXPECT_FALSE(FindProblem(r)) << *FindProblem(r);
  for (const auto& [id, point] : r.points) {
    EXPECT_GE(point.track.size(), 2u);
    EXPECT_TRUE(std::isfinite(point.error_px));
  }
}

TEST(Summarize, SaysHowItWent) {
  const Case c = MakeCase();
  const Calibration summary = c.Summary();
  EXPECT_EQ(summary.photos_total, 5);
  EXPECT_EQ(summary.photos_posed, 3);
  EXPECT_GT(summary.reprojection_error_px, 0.2);
  EXPECT_LT(summary.reprojection_error_px, 0.8);
  EXPECT_GT(summary.points, 100);
  EXPECT_GT(summary.mean_track_length, 2);
  EXPECT_LE(summary.mean_track_length, 3);
  EXPECT_EQ(summary.prior_rms_horizontal_m, 0.8);
  EXPECT_EQ(summary.prior_rms_vertical_m, 0.9);
}

TEST(Summarize, SaysItForEveryPhoto) {
  const Case c = MakeCase();
  const Calibration summary = c.Summary();
  ASSERT_EQ(summary.photos.size(), 3u);
  for (int i = 0; i < 3; ++i) {
    const CalibratedPhoto& photo = summary.photos[i];
    EXPECT_EQ(photo.path, c.scene.photos[i].name);
    EXPECT_EQ(photo.observations, NumUsedObservations(c.scene, i));
    EXPECT_GT(photo.reprojection_error_px, 0.2);
    EXPECT_LT(photo.reprojection_error_px, 0.8);
    EXPECT_EQ(photo.prior_residual_m, c.priors.distance_m[i]);
    EXPECT_EQ(photo.prior_outlier, i == 2);
    EXPECT_GT(photo.coverage, 0.2);
    EXPECT_LE(photo.coverage, 1);
  }
  ASSERT_EQ(summary.unposed.size(), 2u);
  EXPECT_EQ(summary.unposed[0].path, "a/broken.jpg");
  EXPECT_EQ(summary.unposed[0].why, "the file ends early; copy it again");
  EXPECT_EQ(summary.unposed[1].path, c.scene.photos[3].name);
  EXPECT_EQ(summary.unposed[1].why, "it overlaps with no other photo");
}

TEST(Summarize, CoverageIsTheShareOfFilledCells) {
  Case c = MakeCase();
  for (Eigen::Vector2d& keypoint : c.scene.photos[0].keypoints) keypoint = {605, 455};
  EXPECT_NEAR(c.Summary().photos[0].coverage, 0.01, 1e-12);
}

TEST(Summarize, SaysWhatIsKnownAboutTheCamera) {
  Case c = MakeCase();
  Calibration summary = c.Summary();
  ASSERT_EQ(summary.cameras.size(), 1u);
  EXPECT_EQ(summary.cameras[0].label, "Made 1200 x 900");
  EXPECT_EQ(summary.cameras[0].model, "OPENCV");
  EXPECT_EQ(summary.cameras[0].params, c.scene.cameras[0].intrinsics.params);
  ASSERT_EQ(summary.cameras[0].sigma.size(), 8u);
  EXPECT_GT(summary.cameras[0].sigma[0], 0);
  EXPECT_LT(summary.cameras[0].sigma[0], 100);

  c.scene.cameras[0].focal_sigma_ratio = 0;  // given as the truth
  summary = c.Summary();
  EXPECT_EQ(summary.cameras[0].held, summary.cameras[0].names);
  EXPECT_EQ(summary.cameras[0].sigma, std::vector<double>(8, 0.0));
}

TEST(Summarize, NamesWhatThePhotosDoNotDetermine) {
  Case c = MakeCase();
  // Two photos of one plane from nearly one place say nothing about the focal length.
  c.scene = MakeScene({.num_photos = 2,
                       .num_points = 60,
                       .num_planes = 1,
                       .clutter_share = 0,
                       .arc_rad = 0.1,
                       .noise_px = 0.2});
  c.capture_of_photo = {0, 2};
  c.unregistered = {};
  c.priors.distance_m = {-1, -1};
  c.outliers = {};
  const auto held = c.Summary().cameras.at(0).held;
  EXPECT_NE(std::find(held.begin(), held.end(), "fx"), held.end());
}

}  // namespace
}  // namespace stucco::test
