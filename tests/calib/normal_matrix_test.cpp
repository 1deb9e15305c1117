// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/normal_matrix.h"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <algorithm>
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

TEST(NormalMatrix, SolvesRows) {
  const Chain chain = MakeChain(8, 0.1);
  EXPECT_TRUE(chain.blocks.Diagonal().isApprox(chain.dense.diagonal()));
  const Eigen::MatrixXd right = Eigen::MatrixXd::Identity(chain.dense.rows(), chain.dense.cols());
  const auto factor = chain.blocks.Factor();
  ASSERT_TRUE(factor);
  const auto inverse = factor->Solve(right, 2);
  ASSERT_TRUE(inverse);
  EXPECT_TRUE(inverse->isApprox(chain.dense.inverse(), 1e-9));
  EXPECT_EQ(*inverse, *factor->Solve(right, 1));
}

TEST(NormalMatrix, SolvesWhatHasVeryDifferentUnits) {
  NormalMatrix matrix(2);
  matrix.Add(0, 0, (Eigen::Matrix2d() << 1e12, 1, 1, 1e-10).finished());
  const auto factor = matrix.Factor();
  ASSERT_TRUE(factor);
  const auto solved = factor->Solve(Eigen::RowVector2d(1e12, 1), 1);
  ASSERT_TRUE(solved);
  EXPECT_NEAR((*solved)(0, 0), 1, 1e-9);
  EXPECT_NEAR((*solved)(0, 1), 0, 1e-3);
}

TEST(NormalMatrix, NothingWhereItIsNotPositiveDefinite) {
  NormalMatrix empty(2);
  empty.AddToDiagonal(0, Eigen::VectorXd::Ones(1));
  EXPECT_FALSE(empty.Factor());
  NormalMatrix indefinite(2);
  indefinite.Add(0, 0, (Eigen::Matrix2d() << 1, 2, 2, 1).finished());
  EXPECT_FALSE(indefinite.Factor());
}

}  // namespace
}  // namespace stucco::test
