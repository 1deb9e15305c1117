// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/contradicting_groups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "calib/mapping/wrong_poses.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

class ContradictingGroupsTest : public testing::Test {
 protected:
  ContradictingGroupsTest() {
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
    truth_ = MakeScene(
        {.num_photos = 30, .num_points = 900, .num_planes = 3, .arc_rad = 2, .noise_px = 0.3});
    scene_ = truth_;
    records_ = MakeRecords(truth_, {});
    ApplyRecords(records_, MeasureRecordErrors(records_, scene_), scene_);
  }

  // Turns photos about a point, as one body.
  void Turn(const std::vector<int>& photos, double angle_rad) {
    const Eigen::Vector3d about = *truth_.tracks[0].position;
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
    for (const int photo : photos) {
      const Pose& pose = *scene_.photos[photo].pose;
      const Eigen::Quaterniond rotation = pose.rotation * turn.conjugate();
      const Eigen::Vector3d center = about + turn * (pose.Center() - about);
      scene_.photos[photo].pose = Pose{rotation, -(rotation * center)};
    }
  }

  StageContext context_;
  Scene truth_;
  Scene scene_;
  std::vector<PoseRecord> records_;
};

TEST_F(ContradictingGroupsTest, NoneAreFoundWhereRecordsAreNoise) {
  EXPECT_TRUE(OffTogether(scene_).empty());
  EXPECT_TRUE(ContradictingGroups(scene_, std::vector<bool>(30, false)).empty());
}

// Each agrees with its own record; all together cannot.
TEST_F(ContradictingGroupsTest, APartThatIsTurnedIsFoundAndMended) {
  Turn({0, 1, 2, 3, 4, 5, 6, 7}, 1.0 * kDegree);
  for (int photo = 0; photo < 8; ++photo) {
    ASSERT_EQ(JudgePose(scene_, photo), RecordVerdict::kAgrees);
  }
  const std::vector<int> off = OffTogether(scene_);
  EXPECT_GE(off.size(), 4U);
  EXPECT_TRUE(std::ranges::all_of(off, [](int photo) { return photo < 8; }));
  MapperOptions options;
  const WrongPoses wrong = MendWrongPoses(options, context_, scene_);
  EXPECT_EQ(wrong.corrected, off);
  EXPECT_TRUE(OffTogether(scene_).empty());
}

// One line of a flight whose gimbal was off, between positions that are good to a centimetre.
TEST_F(ContradictingGroupsTest, WherePositionsDenyATurnTheGimbalsAreOff) {
  records_ = MakeRecords(truth_, {.position_sigma_m = 0.01});
  ApplyRecords(records_, MeasureRecordErrors(records_, scene_), scene_);
  const auto turn_gimbals = [&] {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(1.0 * kDegree, Eigen::Vector3d::UnitZ()));
    for (int photo = 0; photo < 8; ++photo) {
      Eigen::Quaterniond& gimbal = scene_.photos[photo].attitude->cam_from_world;
      gimbal = gimbal * turn;
    }
  };
  turn_gimbals();
  EXPECT_TRUE(ContradictingGroups(scene_, std::vector<bool>(30, true)).empty());
  // Positions that are good to half a metre cannot deny it.
  records_ = MakeRecords(truth_, {});
  ApplyRecords(records_, MeasureRecordErrors(records_, scene_), scene_);
  turn_gimbals();
  EXPECT_GE(ContradictingGroups(scene_, std::vector<bool>(30, true)).size(), 4U);
}

// What is common to neighbours' records is no more than half of their variance: a single one that
// is far off does not accuse the others.
TEST_F(ContradictingGroupsTest, OneAloneIsNoGroup) {
  Turn({12}, 0.9 * kDegree);
  const std::vector<int> off = OffTogether(scene_);
  EXPECT_TRUE(std::ranges::all_of(off, [](int photo) { return photo == 12; }));
}

}  // namespace
}  // namespace stucco::test
