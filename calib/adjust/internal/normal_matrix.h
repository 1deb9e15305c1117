// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/SparseCholesky>
#include <cstdint>
#include <memory>
#include <optional>
#include <unordered_map>
#include <vector>

namespace stucco {

// The sparse Cholesky factor of a matrix whose unknowns have different units.
class NormalFactor {
 public:
  // Solutions of right sides, a row each; nothing where they are not finite.
  std::optional<Eigen::MatrixXd> Solve(const Eigen::MatrixXd& right, int threads) const;

 private:
  friend class NormalMatrix;
  using Factor = Eigen::SimplicialLLT<Eigen::SparseMatrix<double>, Eigen::Lower>;

  Eigen::VectorXd scale_;  // that brings the diagonal to ones
  std::unique_ptr<const Factor> factor_;
};

// A symmetric matrix that is summed up block by block, of which most blocks are zero.
class NormalMatrix {
 public:
  explicit NormalMatrix(int size) : diagonal_(Eigen::VectorXd::Zero(size)) {}

  // Of the lower triangle (row >= col; of blocks on the diagonal only what lies below it counts).
  // Blocks at the same place have the same size; others do not overlap.
  void Add(int row, int col, const Eigen::Ref<const Eigen::MatrixXd>& block);
  void AddToDiagonal(int at, const Eigen::Ref<const Eigen::VectorXd>& values);
  Eigen::VectorXd Diagonal() const;

  // Most of the time and memory of solving. Nothing where it is not positive definite.
  std::optional<NormalFactor> Factor() const;

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
