// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/mapper.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "calib/adjust/adjust.h"
#include "survey/error.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

class Mapper : public testing::Test {
 protected:
  Mapper() {
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
  }

  // What calibration does after matching, from a guessed camera.
  MapReport Run(const Scene& truth, const std::vector<PhotoPair>& matches) {
    scene_ = Blank(truth);
    for (Camera* camera : {&scene_.cameras[0].intrinsics, &scene_.cameras[0].prior}) {
      camera->params = {1020, 1020, 600, 450, 0, 0, 0, 0};
    }
    pairs_ = Verified(scene_, matches);
    SetTracks(pairs_, scene_);
    const MapReport report = Reconstruct({}, pairs_, context_, scene_);
    unregistered_ = ExplainUnregistered({}, pairs_, scene_);
    RefineAll({}, false, context_, scene_);
    return report;
  }

  StageContext context_;
  Scene scene_;
  std::vector<VerifiedPair> pairs_;
  std::map<int, std::string> unregistered_;
};

void ExpectConsistent(const Scene& scene) {
  for (const SceneTrack& track : scene.tracks) {
    const auto used = std::count_if(track.elements.begin(), track.elements.end(),
                                    [](const SceneElement& e) { return e.used; });
    if (track.position) {
      EXPECT_GE(used, 2);
    } else {
      EXPECT_EQ(used, 0);
    }
    for (const SceneElement& e : track.elements) {
      if (e.used) {
        EXPECT_TRUE(scene.photos[e.photo].pose);
      }
    }
  }
}

TEST_F(Mapper, PlacesEveryPhoto) {
  const Scene truth = MakeScene({.num_photos = 10, .num_points = 350, .noise_px = 0.5});
  const MapReport report = Run(truth, MatchesOf(truth, 0.15, 1));
  EXPECT_EQ(report.num_registered, 10);
  EXPECT_TRUE(unregistered_.empty());
  EXPECT_GE(report.num_initial_pairs_tried, 1);
  const PoseErrors errors = ComparePoses(scene_, truth);
  EXPECT_LT(errors.position_m, 0.05);  // 20 m away, half a pixel is 1 cm
  EXPECT_LT(errors.rotation_rad, 0.003);
  EXPECT_NEAR(scene_.cameras[0].intrinsics.params[0], 1000, 5);
  ExpectConsistent(scene_);
}

TEST_F(Mapper, IsNearlyExactOnCleanMatches) {
  const Scene truth = MakeScene({.num_photos = 6, .num_points = 200});
  const MapReport report = Run(truth, MatchesOf(truth, 0, 1));
  EXPECT_EQ(report.num_registered, 6);
  EXPECT_LT(ComparePoses(scene_, truth).position_m, 2e-3);
}

TEST_F(Mapper, IsRepeatable) {
  const Scene truth = MakeScene({.num_photos = 5, .num_points = 150, .noise_px = 0.5});
  Run(truth, MatchesOf(truth, 0.1, 1));
  const Scene first = scene_;
  Run(truth, MatchesOf(truth, 0.1, 1));
  for (size_t i = 0; i < first.photos.size(); ++i) {
    ASSERT_TRUE(first.photos[i].pose && scene_.photos[i].pose);
    EXPECT_EQ(first.photos[i].pose->translation, scene_.photos[i].pose->translation);
  }
  EXPECT_EQ(first.cameras[0].intrinsics.params, scene_.cameras[0].intrinsics.params);
}

TEST_F(Mapper, KeepsTheLargerOfTwoGroups) {
  const Scene truth = MakeScene({.num_photos = 9, .num_points = 300, .noise_px = 0.3});
  auto matches = MatchesOf(truth, 0, 1);
  std::erase_if(matches, [](const PhotoPair& p) { return (p.first < 3) != (p.second < 3); });
  const MapReport report = Run(truth, matches);
  EXPECT_EQ(report.num_registered, 6);
  EXPECT_EQ(unregistered_.size(), 3u);
  for (int i = 0; i < 9; ++i) {
    EXPECT_EQ(scene_.photos[i].pose.has_value(), i >= 3);
    EXPECT_EQ(unregistered_.contains(i), i < 3);
  }
  EXPECT_NE(unregistered_.at(0).find("only 0 of its keypoints"), std::string::npos);
  EXPECT_LT(ComparePoses(scene_, truth).position_m, 0.05);
  ExpectConsistent(scene_);
}

// The smaller group has by far the most matches, so that all the best pairs are its.
TEST_F(Mapper, FindsTheLargerGroupBehindManyMatches) {
  const Scene truth = MakeScene({.num_photos = 22, .num_points = 500, .arc_rad = 2.5});
  auto matches = MatchesOf(truth, 0, 1);
  const auto in_first = [](int photo) { return photo < 10; };
  std::erase_if(matches,
                [&](const PhotoPair& p) { return in_first(p.first) != in_first(p.second); });
  for (PhotoPair& pair : matches) {
    if (!in_first(pair.first)) pair.matches.resize(std::min<size_t>(pair.matches.size(), 90));
  }
  const MapReport report = Run(truth, matches);
  EXPECT_EQ(report.num_registered, 12);
  EXPECT_EQ(unregistered_.size(), 10u);
  EXPECT_LE(report.num_initial_pairs_tried, 2);
}

// A photo whose keypoints agree on a pose loosely, so that it is placed and dropped again, must not
// keep the mapper busy for ever.
TEST_F(Mapper, EndsWithPhotosThatFitLoosely) {
  Scene truth = MakeScene({.num_photos = 8, .num_points = 200, .noise_px = 0.3});
  Random random(5);
  for (Eigen::Vector2d& pixel : truth.photos[3].keypoints) {
    pixel += Eigen::Vector2d(random.Gauss(5), random.Gauss(5));
  }
  const MapReport report = Run(truth, MatchesOf(truth, 0, 1));
  EXPECT_GE(report.num_registered, 7);
  ExpectConsistent(scene_);
}

TEST_F(Mapper, SaysWhichPhotosOverlapWithNothing) {
  const Scene truth = MakeScene({.num_photos = 6, .num_points = 250, .noise_px = 0.3});
  auto matches = MatchesOf(truth, 0, 1);
  std::erase_if(matches, [](const PhotoPair& p) { return p.first == 4 || p.second == 4; });
  const MapReport report = Run(truth, matches);
  EXPECT_EQ(report.num_registered, 5);
  ASSERT_TRUE(unregistered_.contains(4));
  EXPECT_NE(unregistered_.at(4).find("overlaps with no other photo"), std::string::npos);
}

TEST_F(Mapper, PlacesNothingWhenNothingMatches) {
  const Scene truth = MakeScene({.num_photos = 4, .num_points = 100});
  const MapReport report = Run(truth, {});
  EXPECT_EQ(report.num_registered, 0);
  EXPECT_EQ(unregistered_.size(), 4u);
  EXPECT_EQ(report.num_initial_pairs_tried, 0);
}

TEST_F(Mapper, InventsNoDepthFromOnePlace) {
  const Scene truth = MakeScene({.num_photos = 6, .arc_rad = 0, .noise_px = 0.5});
  const MapReport report = Run(truth, MatchesOf(truth, 0, 1));
  EXPECT_EQ(report.num_registered, 0);
  ASSERT_EQ(unregistered_.size(), 6u);
  EXPECT_NE(unregistered_.at(2).find("rotation only"), std::string::npos);
}

TEST_F(Mapper, WorksWithTwoPhotos) {
  const Scene truth = MakeScene({.num_photos = 2, .arc_rad = 0.4, .noise_px = 0.3});
  EXPECT_EQ(Run(truth, MatchesOf(truth, 0, 1)).num_registered, 2);
  ExpectConsistent(scene_);
}

TEST_F(Mapper, RefineAllUsesPositions) {
  Scene scene = MakeScene({.num_photos = 8, .num_points = 250, .noise_px = 0.3});
  const Scene truth = scene;
  Random random(3);
  for (ScenePhoto& photo : scene.photos) {
    photo.prior = PositionPrior{photo.pose->Center(), 0.02, 0.02};
    photo.pose = Disturbed(*photo.pose, 0.0005, 0.02, random);
  }
  EXPECT_TRUE(RefineAll({}, true, context_, scene).usable);
  for (int i = 0; i < 8; ++i) {
    EXPECT_LT((scene.photos[i].pose->Center() - truth.photos[i].pose->Center()).norm(), 0.03);
  }
}

TEST_F(Mapper, StopsWhenAsked) {
  struct Stopped : Progress {
    void Begin(std::string_view, size_t) override {}
    void Advance(size_t) override {}
    void Warn(std::string_view) override {}
    void Note(std::string_view) override {}
    bool Cancelled() const override { return true; }
  } stopped;
  context_.progress = &stopped;
  const Scene truth = MakeScene({.num_photos = 4, .num_points = 150});
  try {
    Run(truth, MatchesOf(truth, 0, 1));
    FAIL() << "it went on";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kInterrupted);
  }
}

TEST(FilterScene, DropsWhatDoesNotFit) {
  Scene scene = MakeScene({.num_photos = 5, .num_points = 120, .seen_share = 1});
  EXPECT_EQ(FilterScene({}, scene), 0);
  const auto track = std::find_if(scene.tracks.begin(), scene.tracks.end(),
                                  [](const SceneTrack& t) { return t.elements.size() == 5; });
  ASSERT_NE(track, scene.tracks.end());
  const SceneElement& e = track->elements[2];
  scene.photos[e.photo].keypoints[e.keypoint].x() += 9;
  EXPECT_EQ(FilterScene({}, scene), 1);
  EXPECT_FALSE(track->elements[2].used);
  EXPECT_TRUE(track->position);
  // All but one gone: the point goes too.
  for (const int i : {0, 1, 3}) {
    scene.photos[track->elements[i].photo].keypoints[track->elements[i].keypoint].y() -= 50;
  }
  EXPECT_EQ(FilterScene({}, scene), 4);
  EXPECT_FALSE(track->position);
}

TEST(FilterScene, MeasuresInStandardDeviations) {
  Scene scene = MakeScene({.num_photos = 5, .num_points = 120, .seen_share = 1});
  SceneElement& element = scene.tracks[0].elements[0];
  scene.photos[element.photo].keypoints[element.keypoint].x() += 9;
  scene.photos[element.photo].keypoint_sigma_px = 3;
  EXPECT_EQ(FilterScene({}, scene), 0);
  scene.photos[element.photo].keypoint_sigma_px = 2;
  EXPECT_EQ(FilterScene({}, scene), 1);
}

TEST(FilterScene, DropsPosesThatLittleHolds) {
  Scene scene = MakeScene({.num_photos = 5, .num_points = 120, .seen_share = 1});
  for (size_t k = 12; k < scene.photos[2].keypoints.size(); ++k) {
    scene.photos[2].keypoints[k].x() += 30;
  }
  FilterScene({}, scene);
  EXPECT_FALSE(scene.photos[2].pose);
  EXPECT_EQ(NumRegistered(scene), 4);
  ExpectConsistent(scene);
}

// Two photos and a point in one place fit whatever they show.
TEST(FilterScene, DropsPointsRightBeforeALens) {
  Scene scene = MakeScene(
      {.num_photos = 4, .num_points = 60, .seen_share = 1, .model = CameraModel::kPinhole});
  const auto shared = std::ranges::find_if(
      scene.tracks, [](const SceneTrack& track) { return track.elements.size() == 4; });
  ASSERT_NE(shared, scene.tracks.end());
  const Eigen::Vector3d centre = scene.photos[1].pose->Center();
  for (const double share : {0.1, 1e-6}) {
    SceneTrack& track = *shared;
    track.position = centre + share * (*track.position - centre);
    for (SceneElement& element : track.elements) {
      element.used = element.photo == 1 || element.photo == 2;
      if (element.photo != 2) continue;
      const auto pixel = scene.CameraOf(2).Project(*scene.photos[2].pose * *track.position);
      ASSERT_TRUE(pixel);
      scene.photos[2].keypoints[element.keypoint] = *pixel;
    }
    const bool stays = share > 0.01;
    EXPECT_EQ(FilterScene({}, scene), stays ? 0 : 2);
    EXPECT_EQ(track.position.has_value(), stays);
  }
}

TEST(FilterScene, DropsPointsUnderSmallAngles) {
  Scene scene = MakeScene({.num_photos = 4, .num_points = 60});
  FilterScene({.min_angle_rad = 3}, scene);
  for (const SceneTrack& track : scene.tracks) EXPECT_FALSE(track.position);
}

}  // namespace
}  // namespace stucco::test
