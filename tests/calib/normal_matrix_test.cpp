// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/normal_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <random>

namespace stucco::test {
namespace {

constexpr int kBlock = 3;

// A chain of blocks, each of which touches the next, and the first the last.
struct Chain {
  NormalMatrix blocks;
  Eigen::MatrixXd dense;
};

Chain MakeChain(int num_blocks, double smallest) {
  const int size = num_blocks * kBlock;
  Chain chain{NormalMatrix(size), Eigen::MatrixXd::Zero(size, size)};
  std::mt19937 random(3);
  const auto add = [&](int a, int b) {
    Eigen::Matrix<double, kBlock, 2 * kBlock> rows;
    for (double& value : rows.reshaped()) value = static_cast<double>(random() % 1000) / 500 - 1;
    const Eigen::MatrixXd product = rows.transpose() * rows;
    const int low = kBlock * std::min(a, b);
    const int high = kBlock * std::max(a, b);
    chain.blocks.Add(low, low, product.topLeftCorner<kBlock, kBlock>());
    chain.blocks.Add(high, high, product.bottomRightCorner<kBlock, kBlock>());
    chain.blocks.Add(high, low, product.bottomLeftCorner<kBlock, kBlock>());
    chain.dense.block<kBlock, kBlock>(low, low) += product.topLeftCorner<kBlock, kBlock>();
    chain.dense.block<kBlock, kBlock>(high, high) += product.bottomRightCorner<kBlock, kBlock>();
    chain.dense.block<kBlock, kBlock>(high, low) += product.bottomLeftCorner<kBlock, kBlock>();
    chain.dense.block<kBlock, kBlock>(low, high) += product.topRightCorner<kBlock, kBlock>();
  };
  for (int i = 0; i < num_blocks; ++i) add(i, (i + 1) % num_blocks);
  const Eigen::VectorXd more = Eigen::VectorXd::Constant(size, smallest);
  chain.blocks.AddToDiagonal(0, more);
  chain.dense.diagonal() += more;
  return chain;
}

TEST(NormalMatrix, HalfInverseGivesTheInverse) {
  const Chain chain = MakeChain(8, 0.1);
  EXPECT_TRUE(chain.blocks.Diagonal().isApprox(chain.dense.diagonal()));
  const auto half = chain.blocks.HalfInverse(2);
  ASSERT_TRUE(half);
  EXPECT_TRUE((half->transpose() * *half).isApprox(chain.dense.inverse(), 1e-6));
}

// Of many rows also what blocks far from each other have in common.
TEST(NormalMatrix, SamplesShowTheInverse) {
  constexpr int kRows = 20000;
  const Chain chain = MakeChain(8, 0.01);
  const auto half = chain.blocks.SampledHalfInverse(kRows, 2);
  ASSERT_TRUE(half);
  const Eigen::MatrixXd shown = half->transpose() * *half;
  const Eigen::MatrixXd inverse = chain.dense.inverse();
  for (Eigen::Index i = 0; i < inverse.rows(); ++i) {
    for (Eigen::Index j = 0; j < inverse.cols(); ++j) {
      const double usual = std::sqrt(inverse(i, i) * inverse(j, j) / kRows);
      EXPECT_NEAR(shown(i, j), inverse(i, j), 6 * usual) << i << " " << j;
    }
  }
}

TEST(NormalMatrix, SamplesDoNotDependOnThreads) {
  const Chain chain = MakeChain(8, 0.1);
  EXPECT_EQ(*chain.blocks.SampledHalfInverse(50, 1), *chain.blocks.SampledHalfInverse(50, 4));
}

TEST(NormalMatrix, NothingWhereItIsSingular) {
  NormalMatrix nothing_at_all(2);
  nothing_at_all.AddToDiagonal(0, Eigen::VectorXd::Ones(1));
  EXPECT_FALSE(nothing_at_all.HalfInverse(1));
  EXPECT_FALSE(nothing_at_all.SampledHalfInverse(10, 1));
  NormalMatrix indefinite(2);
  indefinite.Add(0, 0, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  EXPECT_FALSE(indefinite.HalfInverse(1));
  EXPECT_FALSE(indefinite.SampledHalfInverse(10, 1));
}

}  // namespace
}  // namespace stucco::test
