// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/known_poses.h"

#include <gtest/gtest.h>

#include <initializer_list>

#include "tests/calib/made_records.h"
#include "tests/site/made_plan.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

class KnowPosesTest : public testing::Test {
 protected:
  KnowPosesTest() {
    scene_ = MakeScene({.num_photos = 6, .num_points = 400});
    records_ = MakeRecords(scene_, {});
    ApplyRecords(records_, MeasureRecordErrors(records_, scene_), scene_);
    // The plan's frame is the records', 100 m east.
    std::vector<std::optional<Pose>> expected;
    for (const PoseRecord& record : records_) {
      const Vector3d center = record.position->position + kEast;
      expected.emplace_back(Pose{*record.gimbal, -(*record.gimbal * center)});
    }
    guidance_.views.emplace(ExpectedViews{expected, {}, {}, Occluders({}, {})});
    repeating_.wall_of.resize(scene_.photos.size());
  }

  // All that they show is of a wall that repeats itself.
  void LetRepeat(std::initializer_list<int> photos) {
    for (const int photo : photos) {
      repeating_.wall_of[photo].assign(scene_.photos[photo].keypoints.size(), 0);
    }
  }

  std::vector<std::optional<KnownPose>> Know() const {
    return KnowPoses({guidance_, repeating_, records_}, scene_).poses;
  }

  inline static const Vector3d kEast{100, 0, 0};
  Scene scene_;
  std::vector<PoseRecord> records_;

  Guidance guidance_;
  OnRepeatingWalls repeating_;
};

TEST_F(KnowPosesTest, TakesTheRecordWhereNoPoseIsSure) {
  scene_.photos[2].pose.reset();
  scene_.photos[3].pose.reset();
  scene_.photos[3].prior.reset();
  const auto known = Know();
  ASSERT_EQ(known.size(), 6U);
  EXPECT_FALSE(known[3]);
  ASSERT_TRUE(known[1] && known[2]);
  EXPECT_LT(known[1]->sigma_m.maxCoeff(), 0.1);
  EXPECT_LT((known[1]->cam_from_plan.Center() - scene_.photos[1].pose->Center() - kEast).norm(),
            1e-6);
  EXPECT_GE(known[2]->sigma_m[0], scene_.photos[2].prior->sigma_horizontal_m);
  EXPECT_LT((known[2]->cam_from_plan.Center() - scene_.photos[2].prior->position - kEast).norm(),
            1e-6);
}

TEST_F(KnowPosesTest, TakesThePoseOfWhatHangsOnOthers) {
  LetRepeat({4, 5});
  EXPECT_LT(Know()[4]->sigma_m.maxCoeff(), 0.1);
  EXPECT_FALSE(Know()[4]->is_recorded);
}

TEST_F(KnowPosesTest, TakesThePlaceOfOthersOfTheHover) {
  scene_.photos[2].pose.reset();
  for (const int photo : {1, 2, 3}) scene_.photos[photo].hover = 4;
  LetRepeat({3});  // hangs on the others, and is sure by them
  scene_.hover_sigma_m = 0.1;
  const auto known = Know()[2];
  ASSERT_TRUE(known);
  EXPECT_FALSE(known->is_recorded);
  EXPECT_LT(known->sigma_m.maxCoeff(), 0.2);
  const Vector3d middle =
      (scene_.photos[1].pose->Center() + scene_.photos[3].pose->Center()) / 2 + kEast;
  EXPECT_LT((known->cam_from_plan.Center() - middle).norm(), 1e-6);
  EXPECT_LT(
      known->cam_from_plan.rotation.angularDistance(scene_.photos[2].attitude->cam_from_world),
      1e-6);
  // Where the drone did not stand still, the record is better.
  scene_.hover_sigma_m = 50;
  EXPECT_TRUE(Know()[2]->is_recorded);
}

TEST_F(KnowPosesTest, LieOnTheMapOnlyWherePointsShowWalls) {
  guidance_.facades = TwoHouses().facades;
  EXPECT_FALSE(KnowPoses({guidance_, repeating_, records_}, scene_).on_map);
}

TEST_F(KnowPosesTest, TakesTheRecordsOfPhotosThatHangOnEachOther) {
  LetRepeat({0, 1, 2, 3, 4, 5});
  for (const auto& known : Know()) {
    ASSERT_TRUE(known);
    EXPECT_GE(known->sigma_m[0], scene_.photos[0].prior->sigma_horizontal_m);
    EXPECT_TRUE(known->is_recorded);
  }
}

}  // namespace
}  // namespace stucco::test
