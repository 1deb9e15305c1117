// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/focal.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <Eigen/LU>

#include "calib/two_view/verify.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {
namespace {

constexpr int kWidth = 1200;
constexpr int kHeight = 900;

Eigen::Matrix3d Cross(const Eigen::Vector3d& t) {
  Eigen::Matrix3d m;
  m << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  return m;
}

Eigen::Matrix3d Fundamental(const Pose& second_from_first, double focal) {
  Eigen::Matrix3d k;
  k << focal, 0, kWidth / 2.0, 0, focal, kHeight / 2.0, 0, 0, 1;
  const Eigen::Matrix3d essential =
      Cross(second_from_first.translation) * second_from_first.rotation.toRotationMatrix();
  const Eigen::Matrix3d f = k.inverse().transpose() * essential * k.inverse();
  return f / f.norm();
}

std::vector<FocalEvidence> RandomPairs(int count, double focal) {
  Random random(4);
  std::vector<FocalEvidence> pairs;
  for (int i = 0; i < count; ++i) {
    Pose motion;
    motion.rotation = Eigen::AngleAxisd(random.Uniform(0.1, 0.5), random.Vector(1).normalized());
    motion.translation = random.Vector(1).normalized();
    pairs.push_back({Fundamental(motion, focal), 100});
  }
  return pairs;
}

TEST(FocalFromFundamentals, RecoversTheFocalLength) {
  for (const double focal : {700.0, 1000.0, 2200.0}) {
    const auto found = FocalFromFundamentals(RandomPairs(20, focal), kWidth, kHeight);
    ASSERT_TRUE(found);
    EXPECT_NEAR(*found / focal, 1, 0.01);  // the search goes in steps of a per cent
  }
}

TEST(FocalFromFundamentals, SurvivesWrongPairs) {
  std::vector<FocalEvidence> pairs = RandomPairs(30, 1000);
  Random random(6);
  for (size_t i = 0; i < pairs.size(); i += 3) {
    for (int k = 0; k < 9; ++k) pairs[i].fundamental(k / 3, k % 3) = random.Gauss(1);
  }
  const auto found = FocalFromFundamentals(pairs, kWidth, kHeight);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1000, 30);
}

TEST(FocalFromFundamentals, IsRightFromNoisyMatches) {
  // The model has no distortion, but a principal point some pixels off the middle.
  const Scene scene = MakeScene(
      {.num_photos = 10, .num_points = 400, .noise_px = 0.5, .model = CameraModel::kPinhole});
  std::vector<FocalEvidence> pairs;
  for (const VerifiedPair& pair : Verified(scene, MatchesOf(scene, 0.2, 1))) {
    pairs.push_back({pair.geometry.fundamental, pair.geometry.num_fundamental});
  }
  const auto found = FocalFromFundamentals(pairs, kWidth, kHeight);
  ASSERT_TRUE(found);
  EXPECT_NEAR(*found, 1000, 100);
}

TEST(FocalFromFundamentals, NothingWithoutEvidence) {
  EXPECT_FALSE(FocalFromFundamentals({}, kWidth, kHeight));
  // Noise has no valley in common.
  Random random(6);
  std::vector<FocalEvidence> pairs(30);
  for (FocalEvidence& pair : pairs) {
    for (int k = 0; k < 9; ++k) pair.fundamental(k / 3, k % 3) = random.Gauss(1);
    pair.num_inliers = 100;
  }
  EXPECT_FALSE(FocalFromFundamentals(pairs, kWidth, kHeight));
}

TEST(FocalFromFundamentals, NothingFromStraightFlights) {
  // Without rotation every focal length makes the two singular values equal.
  Random random(8);
  std::vector<FocalEvidence> pairs;
  for (int i = 0; i < 20; ++i) {
    Pose motion;
    motion.translation = {1, random.Uniform(-0.2, 0.2), 0};
    FocalEvidence pair{Fundamental(motion, 1000), 100};
    for (int k = 0; k < 9; ++k) pair.fundamental(k / 3, k % 3) += random.Gauss(1e-9);
    pairs.push_back(pair);
  }
  EXPECT_FALSE(FocalFromFundamentals(pairs, kWidth, kHeight));
}

}  // namespace
}  // namespace stucco::test
