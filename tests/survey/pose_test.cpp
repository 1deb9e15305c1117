// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/pose.h"

#include <gtest/gtest.h>

#include <random>

#include "tests/survey/support.h"

namespace stucco {
namespace {

Pose SomePose() {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, -2, 0.5).normalized())),
          {1, 2, 3}};
}

Similarity SomeSimilarity() {
  return {2.5,
          Eigen::Quaterniond(Eigen::AngleAxisd(-1.2, Eigen::Vector3d(0, 1, 3).normalized())),
          {-4, 5, 6}};
}

TEST(Pose, InverseAndProductAgreeWithPoints) {
  const Pose pose = SomePose();
  const Eigen::Vector3d point(0.3, -8, 2);
  EXPECT_NEAR((pose.Inverse() * (pose * point) - point).norm(), 0, 1e-12);
  const Pose twice = pose * pose;
  EXPECT_NEAR((twice * point - pose * (pose * point)).norm(), 0, 1e-12);
  EXPECT_NEAR((pose * pose.Center()).norm(), 0, 1e-12);
}

TEST(Similarity, InverseUndoes) {
  const Similarity similarity = SomeSimilarity();
  const Eigen::Vector3d point(0.3, -8, 2);
  EXPECT_NEAR((similarity.Inverse() * (similarity * point) - point).norm(), 0, 1e-12);
}

TEST(Similarity, TransformedPoseSeesTheSamePictureDeeper) {
  const Pose old_pose = SomePose();
  const Similarity new_from_old = SomeSimilarity();
  const Pose new_pose = Transformed(old_pose, new_from_old);
  const Eigen::Vector3d point(0.3, -8, 2);
  const Eigen::Vector3d expected = new_from_old.scale * (old_pose * point);
  EXPECT_NEAR((new_pose * (new_from_old * point) - expected).norm(), 0, 1e-11);
  EXPECT_NEAR((new_pose.Center() - new_from_old * old_pose.Center()).norm(), 0, 1e-11);
}

Eigen::Matrix3Xd Apply(const Similarity& similarity, const Eigen::Matrix3Xd& points) {
  Eigen::Matrix3Xd moved(3, points.cols());
  for (Eigen::Index i = 0; i < points.cols(); ++i) moved.col(i) = similarity * points.col(i);
  return moved;
}

void ExpectNear(const Similarity& actual, const Similarity& expected, double tolerance) {
  EXPECT_NEAR(actual.scale, expected.scale, tolerance);
  EXPECT_LT(actual.rotation.angularDistance(expected.rotation), tolerance);
  EXPECT_LT((actual.translation - expected.translation).norm(), 20 * tolerance);
}

TEST(AlignPoints, RecoversTheSimilarityFromExactPoints) {
  Eigen::Matrix3Xd source(3, 5);
  source << 0, 10, 0, 3, -2, 0, 0, 8, 1, 5, 0, 1, 2, 7, -3;
  ExpectNear(AlignPoints(source, Apply(SomeSimilarity(), source)), SomeSimilarity(), 1e-12);
}

TEST(AlignPoints, TakesPointsOnOnePlaneWithoutMirroring) {
  Eigen::Matrix3Xd source(3, 4);
  source << 0, 10, 0, 3, 0, 0, 8, 1, 0, 0, 0, 0;
  const Similarity found = AlignPoints(source, Apply(SomeSimilarity(), source));
  EXPECT_GT(found.rotation.toRotationMatrix().determinant(), 0.99);
  ExpectNear(found, SomeSimilarity(), 1e-9);
}

TEST(AlignPoints, AveragesNoise) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.01);
  Eigen::Matrix3Xd source(3, 400);
  for (Eigen::Index i = 0; i < source.cols(); ++i) {
    source.col(i) = 500 * Eigen::Vector3d(noise(random), noise(random), noise(random));
  }
  Eigen::Matrix3Xd target = Apply(SomeSimilarity(), source);
  for (double& number : target.reshaped()) number += noise(random);
  // Spread 5 m, noise 1 cm, 400 points: about 1e-4 for scale and rotation.
  ExpectNear(AlignPoints(source, target), SomeSimilarity(), 5e-4);
}

TEST(AlignPoints, RefusesTwoPoints) {
  const Eigen::Matrix3Xd two = Eigen::Matrix3Xd::Random(3, 2);
  const Error error = test::ErrorOf([&] { AlignPoints(two, two); });
  EXPECT_EQ(error.kind(), ErrorKind::kStageFailed);
}

}  // namespace
}  // namespace stucco
