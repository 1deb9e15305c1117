// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/hold_by_control.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "calib/records/georeference.h"
#include "tests/calib/made_control.h"
#include "tests/calib/made_records.h"

namespace stucco::test {
namespace {

const Eigen::Vector3d kSigma_m(0.02, 0.02, 0.03);
const Eigen::Vector3d kShift(5, -3, 2);

// A calibrated scene whose positions put it 5 m off, and points that were surveyed where they are.
class HoldByControlTest : public testing::Test {
 protected:
  HoldByControlTest() {
    MadeOptions options;
    options.num_photos = 14;
    options.num_points = 500;
    options.num_planes = 3;
    options.noise_px = 0.5;
    truth_ = MakeScene(options);
    scene_ = truth_;
    scene_.cameras[0].focal_sigma_ratio = 0.01;
    MadeRecordErrors errors;
    errors.position_sigma_m = 0.3;
    errors.shift_m = {kShift};
    records_ = MakeRecords(truth_, errors);
    // What positions hold: shifted, and turned by some tenths of a degree.
    Similarity off;
    off.rotation = Eigen::AngleAxisd(0.006, Eigen::Vector3d(1, 2, 1).normalized());
    off.scale = 1.004;
    off.translation = kShift + Eigen::Vector3d(0.1, -0.05, 0.1);
    Transform(off, scene_);
    mapper_.min_angle_rad = 0.026;
    context_.progress = &SilentProgress();
    context_.units = &NoUnits();
    control_ = MakeControl(truth_, frame_, MadeCorners(), 0.5);
  }

  ControlOutcome Hold() {
    return HoldByControl({control_, kSigma_m, mapper_, records_, georef_, context_}, scene_);
  }

  void WithoutPositions() {
    for (PoseRecord& record : records_) record = {};
    Similarity any;
    any.rotation = Eigen::AngleAxisd(1.9, Eigen::Vector3d(1, -2, 0.5).normalized());
    any.scale = 0.13;
    any.translation = {3, 2, 1};
    Transform(any, scene_);
    georef_ = {};
    georef_.source = "none";
  }

  // Largest distance of a photo from where it truly was, in the frame that control points hold.
  double WorstPosition(const Georef& georef) const {
    double worst = 0;
    for (size_t i = 0; i < scene_.photos.size(); ++i) {
      const Eigen::Vector3d place = GeodeticFromEnu(georef, scene_.photos[i].pose->Center());
      const Eigen::Vector3d at = EnuFromGeodetic(frame_, place.x(), place.y(), place.z());
      worst = std::max(worst, (at - truth_.photos[i].pose->Center()).norm());
    }
    return worst;
  }

  Scene truth_;
  Scene scene_;
  std::vector<PoseRecord> records_;
  MapperOptions mapper_;
  StageContext context_;
  const Georef frame_ = MadeFrame();
  Georef georef_ = frame_;
  GroundControl control_;
};

TEST_F(HoldByControlTest, ShiftedPositionsDoNotMatter) {
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef) << outcome.why_not;
  EXPECT_EQ(outcome.georef->source, "gcp");
  EXPECT_EQ(outcome.georef->origin_latitude_deg, frame_.origin_latitude_deg);
  EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
  ASSERT_TRUE(outcome.positions_shift_m);
  // The mean of 14 positions with 0.3 m of noise.
  EXPECT_LT((*outcome.positions_shift_m - kShift).norm(), 0.3);
  for (const PointOutcome& point : outcome.points) {
    EXPECT_EQ(point.state, PointState::kUsed);
    ASSERT_TRUE(point.error_m);
    EXPECT_LT(point.error_m->norm(), 0.03);
  }
}

TEST_F(HoldByControlTest, ThePlanRecordedNoPositionsThatCouldBeShifted) {
  georef_.source = "plan";
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef) << outcome.why_not;
  EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
  EXPECT_FALSE(outcome.positions_shift_m);
}

TEST_F(HoldByControlTest, PositionsGoodToCentimetresButShiftedDoNotFight) {
  MadeRecordErrors errors;
  errors.position_sigma_m = 0.01;
  errors.shift_m = {kShift};
  records_ = MakeRecords(truth_, errors);
  for (PoseRecord& record : records_) {
    record.position->sigma_horizontal_m = record.position->sigma_vertical_m = 0.01;
  }
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef) << outcome.why_not;
  EXPECT_LT(WorstPosition(*outcome.georef), 0.025);
  EXPECT_LT((*outcome.positions_shift_m - kShift).norm(), 0.02);
  // What is said of the photos' positions is what the shift leaves.
  EXPECT_LT(MeasurePriors(scene_, {}).rms_horizontal_m, 0.03);
}

TEST_F(HoldByControlTest, HoldsSurveysWithoutPositions) {
  WithoutPositions();
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef) << outcome.why_not;
  EXPECT_EQ(outcome.georef->frame, "enu");
  EXPECT_TRUE(outcome.georef->metric);
  EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
  EXPECT_FALSE(outcome.positions_shift_m);
}

TEST_F(HoldByControlTest, CheckPointsTakePartInNothing) {
  control_.points[3].role = PointRole::kCheck;
  control_.points[5].role = PointRole::kCheck;
  Scene again = scene_;
  const ControlOutcome first = Hold();
  ASSERT_TRUE(first.georef);
  EXPECT_EQ(first.points[3].state, PointState::kMeasured);
  EXPECT_LT(first.points[3].error_m->norm(), 0.04);
  const Scene after = scene_;
  // Wrong ones change nothing but what is said of them.
  scene_ = again;
  MovePoint(frame_, {0.5, 0, 0}, control_.points[3]);
  control_.points[5].marks.clear();
  const ControlOutcome second = Hold();
  EXPECT_NEAR(second.points[3].error_m->x(), first.points[3].error_m->x() - 0.5, 1e-9);
  EXPECT_EQ(second.points[5].state, PointState::kNotSeen);
  for (size_t i = 0; i < scene_.photos.size(); ++i) {
    EXPECT_EQ(scene_.photos[i].pose->Center(), after.photos[i].pose->Center());
  }
}

TEST_F(HoldByControlTest, NamesAGrossBlunderAndGoesOnWithoutIt) {
  const Scene shifted = scene_;
  for (const bool has_positions : {true, false}) {
    for (const double error_m : {0.25, 1.0, 30.0}) {
      SCOPED_TRACE(error_m);
      scene_ = shifted;
      if (!has_positions) WithoutPositions();
      control_ = MakeControl(truth_, frame_, MadeCorners(), 0.5);
      MovePoint(frame_, {0, 0, error_m}, control_.points[2]);
      const ControlOutcome outcome = Hold();
      ASSERT_TRUE(outcome.georef) << outcome.why_not;
      EXPECT_EQ(outcome.points[2].state, PointState::kBlunder);
      EXPECT_NEAR(outcome.points[2].error_m->z(), -error_m, 0.05);
      EXPECT_NE(outcome.points[2].why.find("not used"), std::string::npos);
      EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
      for (const size_t i : {0, 1, 3, 4, 5, 6}) {
        EXPECT_EQ(outcome.points[i].state, PointState::kUsed);
      }
    }
  }
}

TEST_F(HoldByControlTest, NamesAMarkOfAnotherPlace) {
  PhotoMark& wrong = control_.points[0].marks[1];
  wrong.pixel.x() += wrong.pixel.x() > 600 ? -80 : 80;
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef);
  EXPECT_EQ(outcome.points[0].state, PointState::kUsed);
  ASSERT_EQ(outcome.points[0].measured.refused.size(), 1u);
  EXPECT_NE(outcome.points[0].why.find(scene_.photos[wrong.photo].name), std::string::npos);
  EXPECT_NE(outcome.points[0].why.find("80 px"), std::string::npos) << outcome.points[0].why;
  EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
}

TEST_F(HoldByControlTest, TwoPointsAreOnlyChecks) {
  control_.points.resize(2);
  const Scene before = scene_;
  const ControlOutcome outcome = Hold();
  EXPECT_FALSE(outcome.georef);
  EXPECT_NE(outcome.why_not.find("three are needed"), std::string::npos);
  EXPECT_EQ(outcome.points[0].state, PointState::kUnused);
  // They say how far the positions are off.
  ASSERT_TRUE(outcome.points[0].error_m);
  EXPECT_LT((*outcome.points[0].error_m - kShift).norm(), 0.5);
  EXPECT_EQ(scene_.photos[0].pose->Center(), before.photos[0].pose->Center());
}

TEST_F(HoldByControlTest, PointsOnOneLineHoldNothing) {
  control_ = MakeControl(truth_, frame_, {{-4, -5, 0}, {0, -5, 0}, {2, -5, 0}, {5, -5, 0}}, 0.5);
  const ControlOutcome outcome = Hold();
  EXPECT_FALSE(outcome.georef);
  EXPECT_NE(outcome.why_not.find("one line"), std::string::npos) << outcome.why_not;
}

TEST_F(HoldByControlTest, OnlyCheckPointsJudgeThePositions) {
  for (MarkedPoint& point : control_.points) point.role = PointRole::kCheck;
  const ControlOutcome outcome = Hold();
  EXPECT_FALSE(outcome.georef);
  EXPECT_TRUE(outcome.why_not.empty());
  for (const PointOutcome& point : outcome.points) {
    EXPECT_EQ(point.state, PointState::kMeasured);
    EXPECT_LT((*point.error_m - kShift).norm(), 0.5);
  }
}

TEST_F(HoldByControlTest, PointsInOnePhotoAreNotSeen) {
  control_.points[1].marks.resize(1);
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef);
  EXPECT_EQ(outcome.points[1].state, PointState::kNotSeen);
  EXPECT_NE(outcome.points[1].why.find("marked in 1 photo"), std::string::npos);
}

TEST_F(HoldByControlTest, WithoutPositionsAndControlNothingIsMeasured) {
  WithoutPositions();
  control_.points.resize(2);
  const ControlOutcome outcome = Hold();
  EXPECT_FALSE(outcome.georef);
  EXPECT_FALSE(outcome.points[0].error_m);
}

// Control points straighten what nothing held.
TEST_F(HoldByControlTest, UnbendsAModel) {
  WithoutPositions();
  Random random(3);
  for (ScenePhoto& photo : scene_.photos) {
    photo.pose = Disturbed(*photo.pose, 0.001, 0.005, random);
  }
  const ControlOutcome outcome = Hold();
  ASSERT_TRUE(outcome.georef) << outcome.why_not;
  EXPECT_LT(WorstPosition(*outcome.georef), 0.03);
}

}  // namespace
}  // namespace stucco::test
