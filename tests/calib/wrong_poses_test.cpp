// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/wrong_poses.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include "calib/adjust/covariance.h"
#include "calib/results/summarize.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

// All that a photo shows is matched to what lies farther along: as where windows repeat.
void MatchElsewhere(int photo, Scene& scene) {
  ScenePhoto& shifted = scene.photos[photo];
  const Pose moved = LookAt(shifted.pose->Center() + Eigen::Vector3d(6, 0, 0),
                            shifted.pose->Center() + Eigen::Vector3d(6, 20, 0));
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& e : track.elements) {
      if (e.photo != photo) continue;
      const auto pixel = scene.CameraOf(photo).Project(moved * *track.position);
      if (pixel) shifted.keypoints[e.keypoint] = *pixel;
    }
  }
  shifted.pose = moved;
}

class WrongPosesTest : public testing::Test {
 protected:
  WrongPosesTest() {
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
    truth_ = MakeScene(
        {.num_photos = 30, .num_points = 600, .num_planes = 3, .arc_rad = 2, .noise_px = 0.3});
    scene_ = truth_;
    records_ = MakeRecords(truth_, {});
    ApplyRecords(records_, MeasureRecordErrors(records_, scene_), scene_);
  }

  StageContext context_;
  Scene truth_;
  Scene scene_;
  std::vector<PoseRecord> records_;
};

TEST_F(WrongPosesTest, NoneAreFoundWhereNoneAre) {
  const WrongPoses wrong = MendWrongPoses({}, context_, scene_);
  EXPECT_TRUE(wrong.corrected.empty());
  EXPECT_TRUE(wrong.taken.empty());
}

TEST_F(WrongPosesTest, TenBrokenOnesAreFoundAndMended) {
  Random random(9);
  std::vector<int> broken;
  for (int i = 1; i < 30; i += 3) {
    broken.push_back(i);
    scene_.photos[i].pose = Disturbed(*scene_.photos[i].pose, 0.1, 3, random);
    ASSERT_EQ(JudgePose(scene_, i), RecordVerdict::kContradicts);
  }
  ASSERT_EQ(broken.size(), 10U);
  const WrongPoses wrong = MendWrongPoses({}, context_, scene_);
  std::vector<int> found = wrong.corrected;
  found.insert(found.end(), wrong.taken.begin(), wrong.taken.end());
  std::sort(found.begin(), found.end());
  EXPECT_EQ(found, broken);
  EXPECT_EQ(wrong.corrected, broken);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.05);
}

TEST_F(WrongPosesTest, AShiftAlongAWallIsNotBelieved) {
  const int photo = 12;
  MatchElsewhere(photo, scene_);
  ASSERT_EQ(JudgePose(scene_, photo), RecordVerdict::kContradicts);
  const WrongPoses wrong = MendWrongPoses({}, context_, scene_);
  EXPECT_EQ(wrong.taken, std::vector{photo});
  EXPECT_FALSE(scene_.photos[photo].pose);
}

// What calibration.json says is all that somebody needs to know which photos not to trust.
TEST_F(WrongPosesTest, TenThatMatchesInsistOnAreToldByTheSummary) {
  Captures captures;
  captures.cameras.push_back({"key", "Made", scene_.cameras[0].prior, "exif_35mm"});
  std::vector<int> capture_of_photo;
  std::map<int, std::string> why;
  std::vector<std::string> broken;
  for (int i = 0; i < 30; ++i) {
    CapturedPhoto photo;
    photo.usable = true;
    photo.path = scene_.photos[i].name;
    captures.photos.push_back(photo);
    capture_of_photo.push_back(i);
    if (i % 3 != 1) continue;
    broken.push_back(photo.path);
    MatchElsewhere(i, scene_);
    ASSERT_EQ(JudgePose(scene_, i), RecordVerdict::kContradicts);
  }
  ASSERT_EQ(broken.size(), 10U);
  const WrongPoses wrong = MendWrongPoses({}, context_, scene_);
  for (const int photo : wrong.taken) why[photo] = "its pose contradicts its record";
  FilterScene({}, scene_);
  const Calibration summary = Summarize({captures,
                                         capture_of_photo,
                                         scene_,
                                         why,
                                         MeasurePriors(scene_, {}),
                                         {},
                                         nullptr,
                                         EstimateSigmas({}, scene_)});
  std::vector<std::string> told;
  for (const UnposedPhoto& photo : summary.unposed) told.push_back(photo.path);
  for (const CalibratedPhoto& photo : summary.photos) {
    if (photo.state != PhotoState::kTied) told.push_back(photo.path);
  }
  std::ranges::sort(told);
  EXPECT_EQ(told, broken);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.05);
}

// Neither alone is more than records may be off by.
TEST_F(WrongPosesTest, PlaceAndDirectionTogetherAreNotBelieved) {
  ScenePhoto& photo = scene_.photos[12];
  const double sigma_m = std::hypot(photo.prior->sigma_horizontal_m, 0.1);
  const double sigma_rad = std::hypot(photo.attitude->sigma_rad, 0.3 * std::numbers::pi / 180);
  const Pose truth = *photo.pose;
  const Eigen::Quaterniond record = photo.attitude->cam_from_world;
  const Eigen::Vector3d place = photo.prior->position + Eigen::Vector3d(4.2 * sigma_m, 0, 0);
  const Eigen::Quaterniond turned =
      Eigen::Quaterniond(Eigen::AngleAxisd(4.2 * sigma_rad, Eigen::Vector3d::UnitX())) * record;
  photo.pose = Pose{record, -(record * place)};
  EXPECT_EQ(JudgePose(scene_, 12), RecordVerdict::kAgrees);
  photo.pose = Pose{turned, -(turned * photo.prior->position)};
  EXPECT_EQ(JudgePose(scene_, 12), RecordVerdict::kAgrees);
  photo.pose = Pose{turned, -(turned * place)};
  EXPECT_EQ(JudgePose(scene_, 12), RecordVerdict::kContradicts);
  // However sure a pose is by itself, its record is not wrong in both by chance.
  photo.prior->position.y() += 5;
  photo.pose = truth;
  EXPECT_EQ(JudgePose(scene_, 12), RecordVerdict::kPositionOff);
  photo.attitude->cam_from_world = turned;
  EXPECT_EQ(JudgePose(scene_, 12), RecordVerdict::kContradicts);
}

TEST_F(WrongPosesTest, APositionIsDistrustedWhereThePoseIsSure) {
  scene_.photos[5].prior->position += Eigen::Vector3d(0, 30, 0);
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
  const WrongPoses wrong = MendWrongPoses({}, context_, scene_);
  EXPECT_TRUE(wrong.corrected.empty());
  EXPECT_TRUE(wrong.taken.empty());
}

// Its neighbours are matched a bay off as it is.
TEST_F(WrongPosesTest, APositionIsBelievedWhereThePoseMayBeBaysOff) {
  scene_.photos[5].prior->position += Eigen::Vector3d(0, 5, 0);
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
  scene_.photos[5].may_be_bays_off = true;
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kContradicts);
  scene_.photos[5].prior->position += Eigen::Vector3d(0, 25, 0);  // so many bays it is not
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
}

// It was taken where the other photo of its hover was, which both records tell.
TEST_F(WrongPosesTest, APositionIsBelievedWhereItsHoverStandsThere) {
  ScenePhoto& photo = scene_.photos[5];
  ScenePhoto& mate = scene_.photos[6];
  const Eigen::Vector3d hover = photo.prior->position;
  mate.pose = Pose{mate.pose->rotation, -(mate.pose->rotation * hover)};
  mate.prior->position = hover;
  const Eigen::Vector3d away = hover + Eigen::Vector3d(0, 5, 0);
  photo.pose = Pose{photo.pose->rotation, -(photo.pose->rotation * away)};
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
  photo.hover = mate.hover = 2;
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);  // how far apart is not known
  scene_.hover_sigma_m = 0.05;
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kContradicts);
  // Both stand where the other was recorded: it is this photo's record that is wrong.
  mate.pose = Pose{mate.pose->rotation, -(mate.pose->rotation * away)};
  mate.prior->position = away;
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
  // A mate whose own record contradicts it is no witness.
  mate.pose = Pose{mate.pose->rotation, -(mate.pose->rotation * hover)};
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kPositionOff);
}

TEST_F(WrongPosesTest, RecordsThatContradictMostPosesAreWrongThemselves) {
  for (size_t i = 0; i < 18; ++i) {
    scene_.photos[i].attitude->cam_from_world =
        Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())) *
        scene_.photos[i].attitude->cam_from_world;
    ASSERT_EQ(JudgePose(scene_, static_cast<int>(i)), RecordVerdict::kContradicts);
  }
  EXPECT_TRUE(ContradictingPoses(scene_).empty());
  EXPECT_TRUE(MendWrongPoses({}, context_, scene_).taken.empty());
}

TEST_F(WrongPosesTest, WithoutRecordsNothingIsJudged) {
  scene_.photos[5].prior.reset();
  scene_.photos[5].attitude.reset();
  scene_.photos[5].pose = LookAt({0, -60, 9}, {20, 0, 0});
  EXPECT_EQ(JudgePose(scene_, 5), RecordVerdict::kAgrees);
}

TEST(SeesSeveralPlanes, CountsWhatLiesOffTheLargest) {
  const Scene one = MakeScene({.num_points = 200, .num_planes = 1, .clutter_share = 0});
  const Scene three = MakeScene({.num_points = 200, .num_planes = 3, .clutter_share = 0});
  EXPECT_FALSE(SeesSeveralPlanes(one, 3));
  EXPECT_TRUE(SeesSeveralPlanes(three, 3));
}

}  // namespace
}  // namespace stucco::test
