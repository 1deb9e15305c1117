// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stucco {

// A symmetric matrix that is summed up block by block, of which most blocks are zero.
class NormalMatrix {
 public:
  explicit NormalMatrix(int size) : diagonal_(Eigen::VectorXd::Zero(size)) {}

  // Of the lower triangle (row >= col; of blocks on the diagonal only what lies below it counts).
  // Blocks at the same place have the same size; others do not overlap.
  void Add(int row, int col, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void AddToDiagonal(int at, const Eigen::Ref<const Eigen::VectorXd>& values);
  Eigen::VectorXd Diagonal() const;

  // Solutions of right sides, a row each, by its sparse Cholesky factor, whose time and memory they
  // take; nothing where it is not positive definite.
  std::optional<Eigen::MatrixXd> Solve(const Eigen::MatrixXd& right, int threads) const;

 private:
  struct Block {
    int row = 0;
    int col = 0;
    Eigen::MatrixXd values;
  };

  Eigen::VectorXd diagonal_;  // what was added to it alone
  std::vector<Block> blocks_;
  std::unordered_map<uint64_t, size_t> index_;
};

}  // namespace stucco
