// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/align.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/evaluate/made_truth.h"

namespace stucco::evaluate {
namespace {

using Eigen::Matrix3Xd;

// Thirty points in a box of some tens of metres; sines are as irregular as is needed.
Matrix3Xd Points() {
  Matrix3Xd points(3, 30);
  for (int i = 0; i < 30; ++i) {
    points.col(i) << 40 * std::sin(1.3 * i), 25 * std::sin(2.9 * i + 1), 8 * std::sin(5.1 * i + 2);
  }
  return points;
}

Matrix3Xd Mapped(const Similarity& map, const Matrix3Xd& points) {
  Matrix3Xd image = points;
  for (int i = 0; i < points.cols(); ++i) image.col(i) = map * Eigen::Vector3d(points.col(i));
  return image;
}

double FarthestOff(const Similarity& a, const Similarity& b, const Matrix3Xd& points) {
  return (Mapped(a, points) - Mapped(b, points)).colwise().norm().maxCoeff();
}

TEST(AlignRobustly, IsExactOnExactPoints) {
  const auto alignment = AlignRobustly(Points(), Mapped(AnySimilarity(), Points()));
  ASSERT_TRUE(alignment);
  EXPECT_LT(FarthestOff(alignment->target_from_source, AnySimilarity(), Points()), 1e-9);
}

TEST(AlignRobustly, IsLeastSquaresOfAllWithoutGrossErrors) {
  Matrix3Xd target = Mapped(AnySimilarity(), Points());
  for (int i = 0; i < 30; ++i) target(i % 3, i) += 0.05 * std::sin(17.0 * i);
  const auto alignment = AlignRobustly(Points(), target);
  ASSERT_TRUE(alignment);
  EXPECT_LT(FarthestOff(alignment->target_from_source, AlignPoints(Points(), target), Points()),
            1e-9);
}

TEST(AlignRobustly, IsNotSpoiltByAFewWrongOnes) {
  Matrix3Xd target = Mapped(AnySimilarity(), Points());
  for (const int i : {0, 4, 9, 13, 17, 21, 22, 25, 28}) target.col(i) += Eigen::Vector3d(30, i, -9);
  const auto alignment = AlignRobustly(Points(), target);
  ASSERT_TRUE(alignment);
  EXPECT_LT(FarthestOff(alignment->target_from_source, AnySimilarity(), Points()), 1e-9);
  EXPECT_FALSE(alignment->used[4]);
  EXPECT_TRUE(alignment->used[5]);
}

TEST(AlignRobustly, HasNothingToSayAboutALineOrTwoPoints) {
  Matrix3Xd line(3, 10);
  for (int i = 0; i < 10; ++i) line.col(i) << i, 2 * i, 5;
  EXPECT_FALSE(AlignRobustly(line, line));
  EXPECT_FALSE(AlignRobustly(Points().leftCols(2), Points().leftCols(2)));
  EXPECT_FALSE(AlignRobustly(Matrix3Xd::Zero(3, 5), Matrix3Xd::Zero(3, 5)));
  EXPECT_FALSE(AlignRobustly(Matrix3Xd(3, 0), Matrix3Xd(3, 0)));
}

}  // namespace
}  // namespace stucco::evaluate
