// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_poses.h"

#include <gtest/gtest.h>

#include "survey/attitude.h"
#include "survey/plan_frame.h"
#include "tests/calib/expect/made_site.h"

namespace stucco::test {
namespace {

using Eigen::Vector3d;

constexpr double kDatum_m = 245;  // what the drone's heights are above the plan's

class ExpectedPosesTest : public testing::Test {
 protected:
  // A photo of a view of its own, taken `off` from it.
  void Add(const Vector3d& planned, const Vector3d& off) {
    PlannedView view;
    view.id = "v" + std::to_string(plan_.views.size());
    view.position_m = planned;
    view.yaw_deg = 30;
    view.pitch_deg = -10;
    plan_.views.push_back(view);
    CapturedPhoto photo;
    photo.view = view.id;
    const Vector3d taken = planned + off;
    const Geodetic place = GeodeticFromPlan(plan_.origin, taken.head<2>());
    photo.position = GeoPosition{
        place.latitude_deg, place.longitude_deg, taken.z() + kDatum_m, true, 1, 1, false};
    photo.gimbal = GimbalAngles{32, -11, 0};
    photos_.push_back(photo);
  }
  std::vector<std::optional<Pose>> Poses() const {
    std::vector<const CapturedPhoto*> pointers;
    for (const CapturedPhoto& photo : photos_) pointers.push_back(&photo);
    return ExpectedPoses(plan_, pointers);
  }

  Plan plan_ = TwoHouses();
  std::vector<CapturedPhoto> photos_;
};

TEST_F(ExpectedPosesTest, AreThoseRecordedWithHeightsOfThePlan) {
  Add({0, -15, 5}, {1, 0, 0});
  Add({5, -15, 5}, {0, 2, 0.5});
  Add({9, -15, 8}, {0, 0, 0});
  const auto poses = Poses();
  ASSERT_TRUE(poses[0] && poses[1] && poses[2]);
  EXPECT_LT((poses[0]->Center() - Vector3d(1, -15, 5)).norm(), 1e-6);
  EXPECT_LT((poses[1]->Center() - Vector3d(5, -13, 5.5)).norm(), 1e-6);
  EXPECT_LT(poses[0]->rotation.angularDistance(CamFromEnu({32, -11, 0})), 1e-12);
}

TEST_F(ExpectedPosesTest, TakeFromThePlanWhatThePhotoDoesNotSay) {
  Add({0, -15, 5}, {3, 3, 3});
  Add({5, -15, 5}, {3, 3, 3});
  photos_[0].gimbal.reset();
  photos_[1].position.reset();
  auto poses = Poses();
  ASSERT_TRUE(poses[0] && poses[1]);
  EXPECT_LT(poses[0]->rotation.angularDistance(CamFromEnu({30, -10, 0})), 1e-12);
  EXPECT_LT((poses[1]->Center() - Vector3d(5, -15, 5)).norm(), 1e-9);
  photos_[0].position->has_height = false;
  poses = Poses();
  EXPECT_LT((poses[0]->Center() - Vector3d(3, -12, 5)).norm(), 1e-6);
}

TEST_F(ExpectedPosesTest, PlaceExtraPhotosByTheHeightsOfTheOthers) {
  Add({0, -15, 5}, {0, 0, 0});
  Add({2, -15, 7}, {0, 0, 0});
  photos_[1].view.clear();
  const auto poses = Poses();
  ASSERT_TRUE(poses[1]);
  EXPECT_LT((poses[1]->Center() - Vector3d(2, -15, 7)).norm(), 1e-6);
}

TEST_F(ExpectedPosesTest, MeasureHeightsOfEachFlightByItself) {
  for (int i = 0; i < 3; ++i) Add({2.0 * i, -15, 5}, {0, 0, 0});
  for (int i = 0; i < 3; ++i) {
    Add({2.0 * i, -20, 7}, {0, 0, -6.1});  // started elsewhere
    plan_.views.back().flight = 1;
  }
  const auto poses = Poses();
  for (int i = 0; i < 6; ++i) {
    ASSERT_TRUE(poses[i]);
    EXPECT_NEAR(poses[i]->Center().z(), i < 3 ? 5 : 7, 0.26) << i;
  }
}

TEST_F(ExpectedPosesTest, DoNotMoveWithEveryPhotoMore) {
  Add({0, -15, 5}, {0, 0, 0.05});
  Add({2, -15, 5}, {0, 0, -0.05});
  const auto before = Poses();
  Add({4, -15, 5}, {0, 0, 0.12});
  EXPECT_EQ(Poses()[0]->translation, before[0]->translation);
}

TEST_F(ExpectedPosesTest, DoNotBelieveAHeightThatIsFarFromThePlan) {
  for (int i = 0; i < 4; ++i) Add({2.0 * i, -15, 5}, {0, 0, 0});
  photos_[1].position->height_m += 60;
  const auto poses = Poses();
  ASSERT_TRUE(poses[1]);
  EXPECT_NEAR(poses[1]->Center().z(), 5, 1e-6);
}

TEST_F(ExpectedPosesTest, AreNoneWhereNothingIsKnown) {
  Add({0, -15, 5}, {0, 0, 0});
  photos_[0].view.clear();  // so that no height ties the drone to the plan
  EXPECT_FALSE(Poses()[0]);
  Add({0, -15, 5}, {0, 0, 0});
  photos_[1].view = "unheard-of";
  photos_[1].gimbal.reset();
  EXPECT_FALSE(Poses()[1]);
}

TEST_F(ExpectedPosesTest, AreNoneForPhotosOfAnotherPlace) {
  for (int i = 0; i < 3; ++i) Add({2.0 * i, -15, 5}, {300, 0, 0});
  for (const auto& pose : Poses()) EXPECT_FALSE(pose);
}

}  // namespace
}  // namespace stucco::test
