// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/summarize_control.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace stucco::test {
namespace {

const Eigen::Vector3d kSurveyedSigma_m(0.02, 0.02, 0.03);

class SummarizeControlTest : public testing::Test {
 protected:
  void AddPoint(const std::string& name, PointState state, const Eigen::Vector3d& error_m) {
    MarkedPoint& marked = control_.points.emplace_back();
    marked.name = name;
    const bool is_check = state == PointState::kMeasured;
    marked.role = is_check ? PointRole::kCheck : PointRole::kControl;
    PointOutcome& point = outcome_.points.emplace_back();
    point.state = state;
    if (state == PointState::kNotSeen) {
      point.why = "marked in 1 photo with a pose, two are needed";
      return;
    }
    point.error_m = error_m;
    point.measured.position = error_m;
    point.measured.used.resize(4);
    point.measured.reprojection_error_px = 0.8;
    point.measured.ground_pixel = 0.02;
  }

  Calibration Summary() {
    Calibration calibration;
    SummarizeControl(control_, outcome_, kSurveyedSigma_m, calibration);
    return calibration;
  }

  static bool HasFinding(const Calibration& calibration, const std::string& part) {
    return std::ranges::any_of(calibration.findings, [&](const std::string& finding) {
      return finding.find(part) != std::string::npos;
    });
  }

  GroundControl control_{"gcp_list.txt", {}, {}};
  ControlOutcome outcome_;
};

TEST_F(SummarizeControlTest, ControlAndCheckApart) {
  outcome_.georef = Georef{};
  AddPoint("A", PointState::kUsed, {0.01, 0, 0});
  AddPoint("B", PointState::kUsed, {-0.01, 0, 0.01});
  AddPoint("C", PointState::kMeasured, {0.03, 0.04, -0.02});
  AddPoint("D", PointState::kBlunder, {3, 0, 0});
  AddPoint("E", PointState::kNotSeen, {});
  const Calibration calibration = Summary();
  ASSERT_EQ(calibration.ground_control.size(), 5u);
  EXPECT_EQ(calibration.ground_control[2].role, "check");
  EXPECT_EQ(calibration.ground_control[2].state, "measured");
  EXPECT_EQ(calibration.ground_control[2].photos, 4);
  EXPECT_EQ(calibration.ground_control[2].error_m, (std::vector<double>{0.03, 0.04, -0.02}));
  EXPECT_EQ(calibration.ground_control[3].state, "blunder");
  EXPECT_EQ(calibration.ground_control[4].state, "not seen");
  EXPECT_TRUE(calibration.ground_control[4].error_m.empty());
  ASSERT_TRUE(calibration.control_rms && calibration.check_rms);
  EXPECT_EQ(calibration.control_rms->points, 2);
  EXPECT_NEAR(calibration.control_rms->horizontal_rms_m, 0.01, 1e-12);
  EXPECT_NEAR(calibration.check_rms->horizontal_rms_m, 0.05, 1e-12);
  EXPECT_NEAR(calibration.check_rms->vertical_rms_m, 0.02, 1e-12);
  EXPECT_TRUE(HasFinding(calibration, "control point E"));
}

TEST_F(SummarizeControlTest, LightsAreInPixelsOnTheGround) {
  // A pixel covers 2 cm: good to 4 cm horizontally and 6 cm vertically, poor from twice that on.
  for (const auto& [error_m, verdict] : {std::pair(Eigen::Vector3d(0.039, 0, 0), "green"),
                                         {{0.041, 0, 0}, "amber"},
                                         {{0, 0.081, 0}, "red"},
                                         {{0, 0, -0.059}, "green"},
                                         {{0, 0, 0.061}, "amber"},
                                         {{0, 0, 0.121}, "red"}}) {
    control_.points.clear();
    outcome_ = {};
    AddPoint("A", PointState::kMeasured, error_m);
    const Calibration calibration = Summary();
    EXPECT_EQ(calibration.ground_control[0].verdict, verdict) << error_m.transpose();
    EXPECT_EQ(calibration.check_rms->verdict, verdict);
  }
}

TEST_F(SummarizeControlTest, NothingIsJudgedMoreFinelyThanItWasSurveyed) {
  AddPoint("A", PointState::kMeasured, {0.015, 0.015, 0.029});
  outcome_.points[0].measured.ground_pixel = 0.002;
  EXPECT_EQ(Summary().ground_control[0].verdict, "green");
}

TEST_F(SummarizeControlTest, SaysThatThereAreNoCheckPoints) {
  outcome_.georef = Georef{};
  AddPoint("A", PointState::kUsed, {0.01, 0, 0});
  EXPECT_TRUE(HasFinding(Summary(), "no check points"));
}

TEST_F(SummarizeControlTest, NamesTheWorstCheckPoint) {
  AddPoint("good", PointState::kMeasured, {0.01, 0, 0});
  AddPoint("bad", PointState::kMeasured, {0.5, 0, 0});
  EXPECT_TRUE(HasFinding(Summary(), "the worst is bad with 0.500 m"));
}

TEST_F(SummarizeControlTest, TellsTheShiftOfPositions) {
  outcome_.georef = Georef{};
  outcome_.positions_shift_m = Eigen::Vector3d(1, 2, 47);
  const Calibration calibration = Summary();
  EXPECT_EQ(calibration.records.shift_m, (std::vector<double>{1, 2, 47}));
  EXPECT_TRUE(HasFinding(calibration, "above the ellipsoid"));
  EXPECT_TRUE(HasFinding(calibration, "47.00 m up"));
}

TEST_F(SummarizeControlTest, SaysWhyPointsHoldNothing) {
  outcome_.why_not = "2 control points of two photos or more: three are needed";
  control_.problems = {"gcp_list.txt, line 7: has 3 fields"};
  const Calibration calibration = Summary();
  EXPECT_TRUE(HasFinding(calibration, "do not hold the model: 2 control points"));
  EXPECT_TRUE(HasFinding(calibration, "line 7"));
  EXPECT_FALSE(calibration.control_rms);
}

}  // namespace
}  // namespace stucco::test
