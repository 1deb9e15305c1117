// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/mapping/start_from_records.h"

#include <gtest/gtest.h>

#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

class FromRecords : public testing::Test {
 protected:
  FromRecords() {
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
    truth_ = MakeScene(
        {.num_photos = 24, .num_points = 900, .num_planes = 3, .arc_rad = 2, .noise_px = 0.3});
  }

  // From a guessed camera, with a tenth of the matches wrong.
  RecordsStart Run(const std::vector<PoseRecord>& records) {
    scene_ = Blank(truth_);
    for (Camera* camera : {&scene_.cameras[0].intrinsics, &scene_.cameras[0].prior}) {
      camera->params = {1015, 1015, 600, 450, 0, 0, 0, 0};
    }
    for (size_t i = 0; i < records.size(); ++i) scene_.photos[i].prior = records[i].position;
    const auto pairs = Verified(scene_, MatchesOf(truth_, 0.1, 3));
    SetTracks(pairs, scene_);
    return StartFromRecords({}, pairs, records, context_, scene_);
  }

  StageContext context_;
  Scene truth_;
  Scene scene_;
};

TEST_F(FromRecords, PlacesEveryPhotoAtOnce) {
  const RecordsStart start = Run(MakeRecords(truth_, {}));
  ASSERT_TRUE(start.usable) << start.why_not;
  EXPECT_EQ(start.num_registered, 24);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.02);
}

TEST_F(FromRecords, FindsACompassThatIsOff) {
  const RecordsStart start = Run(MakeRecords(truth_, {.yaw_rad = {25 * kDegree}}));
  ASSERT_TRUE(start.usable) << start.why_not;
  EXPECT_EQ(start.num_registered, 24);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.02);
  // The frame is that of the positions, not of the compass.
  EXPECT_LT(scene_.photos[0].pose->rotation.angularDistance(truth_.photos[0].pose->rotation),
            3 * kDegree);
}

TEST_F(FromRecords, LivesWithRoughGimbals) {
  const RecordsStart start =
      Run(MakeRecords(truth_, {.position_sigma_m = 1, .attitude_sigma_rad = 2 * kDegree}));
  ASSERT_TRUE(start.usable) << start.why_not;
  EXPECT_GE(start.num_registered, 22);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.02);
}

TEST_F(FromRecords, IsNotPulledByWrongPositions) {
  auto records = MakeRecords(truth_, {});
  for (size_t i = 0; i < records.size(); i += 5) {
    records[i].position->position += Eigen::Vector3d(25, -15, 5);
  }
  const RecordsStart start = Run(records);
  ASSERT_TRUE(start.usable) << start.why_not;
  EXPECT_GE(start.num_registered, 19);
  EXPECT_LT(ComparePoses(scene_, truth_).position_m, 0.05);
}

TEST_F(FromRecords, RefusesAnglesThatTheMatchesContradict) {
  auto records = MakeRecords(truth_, {});
  Random random(4);
  for (PoseRecord& record : records) {
    record.gimbal = Eigen::Quaterniond(
        Eigen::AngleAxisd(random.Uniform(0.5, 2), random.Vector(1).normalized()));
  }
  const RecordsStart start = Run(records);
  EXPECT_FALSE(start.usable);
  EXPECT_NE(start.why_not, "");
  for (const ScenePhoto& photo : scene_.photos) EXPECT_FALSE(photo.pose);
}

TEST_F(FromRecords, NeedsRecordsOfMostPhotos) {
  auto records = MakeRecords(truth_, {});
  for (size_t i = 0; i < 14; ++i) records[i].gimbal.reset();
  EXPECT_FALSE(Run(records).usable);
}

TEST_F(FromRecords, IsTheSameWithAnyNumberOfThreads) {
  const auto records = MakeRecords(truth_, {});
  Run(records);
  const Scene one = scene_;
  scene_ = Blank(truth_);
  for (size_t i = 0; i < records.size(); ++i) scene_.photos[i].prior = records[i].position;
  for (Camera* camera : {&scene_.cameras[0].intrinsics, &scene_.cameras[0].prior}) {
    camera->params = {1015, 1015, 600, 450, 0, 0, 0, 0};
  }
  const auto pairs = Verified(scene_, MatchesOf(truth_, 0.1, 3));
  SetTracks(pairs, scene_);
  StartFromRecords({.threads = 2}, pairs, records, context_, scene_);
  for (size_t i = 0; i < one.photos.size(); ++i) {
    ASSERT_EQ(one.photos[i].pose.has_value(), scene_.photos[i].pose.has_value());
    if (one.photos[i].pose) {
      EXPECT_EQ(one.photos[i].pose->translation, scene_.photos[i].pose->translation);
    }
  }
}

}  // namespace
}  // namespace stucco::test
