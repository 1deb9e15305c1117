// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/fit_control.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>

#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

Similarity AnySimilarity() {
  Similarity result;
  result.scale = 3.7;
  result.rotation = Eigen::AngleAxisd(2.1, Eigen::Vector3d(1, 2, -2).normalized());
  result.translation = {100, -40, 7};
  return result;
}

// A frame that positions hold: a small turn and a shift.
Similarity SmallSimilarity() {
  Similarity result;
  result.scale = 1.003;
  result.rotation = Eigen::AngleAxisd(0.01, Eigen::Vector3d(1, 1, 1).normalized());
  result.translation = {-5, 3, 47};
  return result;
}

std::vector<PointPair> MakePairs(const Similarity& fit, size_t count, double noise_m) {
  Random random(5);
  std::vector<PointPair> pairs;
  for (size_t i = 0; i < count; ++i) {
    const double east = random.Uniform(-40, 40);
    const double north = random.Uniform(-30, 30);
    const Eigen::Vector3d point(east, north, random.Uniform(-2, 4));
    pairs.push_back({point, fit * point + random.Vector(noise_m)});
  }
  return pairs;
}

TEST(FitControl, FindsASimilarity) {
  const Similarity truth = AnySimilarity();
  const auto pairs = MakePairs(truth, 5, 0);
  const ControlFit fit = FitControl(pairs, false);
  ASSERT_TRUE(fit.surveyed_from_scene) << fit.why_not;
  EXPECT_TRUE(fit.blunders.empty());
  for (const PointPair& pair : pairs) {
    EXPECT_LT((*fit.surveyed_from_scene * pair.in_scene - pair.surveyed).norm(), 1e-9);
  }
}

TEST(FitControl, NoiseIsNoBlunder) {
  for (const size_t count : {3, 4, 9, 40}) {
    const ControlFit fit = FitControl(MakePairs(SmallSimilarity(), count, 0.05), true);
    ASSERT_TRUE(fit.surveyed_from_scene) << count << ": " << fit.why_not;
    EXPECT_TRUE(fit.blunders.empty());
    EXPECT_LT((fit.surveyed_from_scene->translation - SmallSimilarity().translation).norm(), 0.15);
  }
}

TEST(FitControl, LeavesBlundersOut) {
  for (const Eigen::Vector3d& error :
       {Eigen::Vector3d(0, 0, 5), Eigen::Vector3d(300, 0, 0), Eigen::Vector3d(0, -4, 1)}) {
    auto pairs = MakePairs(AnySimilarity(), 6, 0.02);
    pairs[4].surveyed += 3.7 * error;
    const ControlFit fit = FitControl(pairs, false);
    ASSERT_TRUE(fit.surveyed_from_scene) << fit.why_not;
    EXPECT_EQ(fit.blunders, std::vector<int>{4});
    EXPECT_NEAR(fit.residual_m[4], 3.7 * error.norm(), 0.2);
  }
}

TEST(FitControl, LeavesTwoOfTwelveOut) {
  auto pairs = MakePairs(SmallSimilarity(), 12, 0.02);
  pairs[1].surveyed += Eigen::Vector3d(10, 0, 0);
  pairs[7].surveyed += Eigen::Vector3d(0, 0, -10);
  EXPECT_EQ(FitControl(pairs, true).blunders, (std::vector<int>{1, 7}));
}

// A height error of one of four turns the plane that the others are in.
TEST(FitControl, SensorsTellWhichOfFourIsWrong) {
  std::vector<PointPair> pairs;
  for (const Eigen::Vector3d& corner : {Eigen::Vector3d(0, 0, 0), Eigen::Vector3d(60, 0, 1),
                                        Eigen::Vector3d(60, 50, 0), Eigen::Vector3d(0, 50, 2)}) {
    pairs.push_back({corner, SmallSimilarity() * corner});
  }
  pairs[2].surveyed.z() += 10;
  EXPECT_EQ(FitControl(pairs, true).blunders, std::vector<int>{2});
  const ControlFit unknown = FitControl(pairs, false);
  EXPECT_FALSE(unknown.surveyed_from_scene);
  EXPECT_NE(unknown.why_not.find("which of them is wrong cannot be told"), std::string::npos);
}

TEST(FitControl, SaysWhatIsMissing) {
  EXPECT_NE(FitControl({}, true).why_not.find("three are needed"), std::string::npos);
  EXPECT_NE(FitControl(MakePairs(SmallSimilarity(), 2, 0), true).why_not.find("2 control points"),
            std::string::npos);
  std::vector<PointPair> line;
  for (int i = 0; i < 5; ++i) {
    const Eigen::Vector3d point(10.0 * i, 5.0 * i + 0.02 * (i % 2), 0);
    line.push_back({point, point});
  }
  EXPECT_NE(FitControl(line, true).why_not.find("one line"), std::string::npos);
}

TEST(FitControl, PointsOfAnotherPlaceContradict) {
  auto pairs = MakePairs(SmallSimilarity(), 6, 0);
  Random random(9);
  for (PointPair& pair : pairs) pair.surveyed = random.Vector(60);
  const ControlFit fit = FitControl(pairs, false);
  EXPECT_FALSE(fit.surveyed_from_scene);
  EXPECT_NE(fit.why_not.find("contradict"), std::string::npos);
}

TEST(FitControl, PointsInOnePlaceAreNone) {
  const std::vector<PointPair> pairs(4);
  EXPECT_FALSE(FitControl(pairs, true).surveyed_from_scene);
}

}  // namespace
}  // namespace stucco::test
