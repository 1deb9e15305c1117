// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stucco {

// A symmetric matrix that is summed up block by block, of which most blocks are zero. All that is
// factorised is scaled to a diagonal of ones first, and has a rounding error added to that: what
// nothing but poor records tie to the rest is held to no more than rounding.
class NormalMatrix {
 public:
  explicit NormalMatrix(int size) : diagonal_(Eigen::VectorXd::Zero(size)) {}

  // Of the lower triangle (row >= col; of blocks on the diagonal only what lies below it counts).
  // Blocks at the same place have the same size; others do not overlap.
  void Add(int row, int col, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void AddToDiagonal(int at, const Eigen::Ref<const Eigen::VectorXd>& values);
  Eigen::VectorXd Diagonal() const;

  // A matrix H with H' H the inverse, lower triangular; nothing where the matrix is singular.
  std::optional<Eigen::MatrixXd> HalfInverse(int threads) const;

  // A matrix H of `rows` rows with H' H the inverse but for the noise of a sample of so many: the
  // rows are drawn with the inverse as their covariance, from the sparse Cholesky factor (Rue,
  // "Fast sampling of Gaussian Markov random fields", 2001), of signs instead of normal variables
  // (Hutchinson 1990). A variance that it shows is off by sqrt(2 / rows) of itself in the root mean
  // square. Time and memory are those of the factor.
  std::optional<Eigen::MatrixXd> SampledHalfInverse(int rows, int threads) const;

 private:
  struct Block {
    int row = 0;
    int col = 0;
    Eigen::MatrixXd values;
  };

  // Nothing where that is not possible.
  std::optional<Eigen::VectorXd> ScaleToOnes() const;

  Eigen::VectorXd diagonal_;  // what was added to it alone
  std::vector<Block> blocks_;
  std::unordered_map<uint64_t, size_t> index_;
};

}  // namespace stucco
