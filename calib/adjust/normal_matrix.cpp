// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/normal_matrix.h"

#include <cassert>

#include "survey/parallel.h"

namespace stucco {

void NormalMatrix::Add(int row, int col, const Eigen::Ref<const Eigen::MatrixXd>& block) {
  assert(row >= col && row + block.rows() <= diagonal_.size());
  const uint64_t key = static_cast<uint64_t>(row) << 32 | static_cast<uint32_t>(col);
  const auto [entry, is_new] = index_.try_emplace(key, blocks_.size());
  if (is_new) {
    blocks_.push_back({row, col, block});
  } else {
    blocks_[entry->second].values += block;
  }
}

void NormalMatrix::AddToDiagonal(int at, const Eigen::Ref<const Eigen::VectorXd>& values) {
  diagonal_.segment(at, values.size()) += values;
}

Eigen::VectorXd NormalMatrix::Diagonal() const {
  Eigen::VectorXd diagonal = diagonal_;
  for (const Block& block : blocks_) {
    if (block.row != block.col) continue;
    diagonal.segment(block.row, block.values.rows()) += block.values.diagonal();
  }
  return diagonal;
}

std::optional<NormalFactor> NormalMatrix::Factor() const {
  NormalFactor result;
  result.scale_ = Diagonal().cwiseSqrt().cwiseInverse();
  const Eigen::VectorXd& scale = result.scale_;
  if (!scale.allFinite()) return std::nullopt;
  const Eigen::Index size = diagonal_.size();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index row, Eigen::Index col, double value) {
    entries.emplace_back(row, col, scale[row] * value * scale[col]);
  };
  for (Eigen::Index i = 0; i < size; ++i) add(i, i, diagonal_[i]);
  for (const Block& block : blocks_) {
    for (Eigen::Index col = 0; col < block.values.cols(); ++col) {
      for (Eigen::Index row = block.row == block.col ? col : 0; row < block.values.rows(); ++row) {
        add(block.row + row, block.col + col, block.values(row, col));
      }
    }
  }
  Eigen::SparseMatrix<double> lower(size, size);
  lower.setFromTriplets(entries.begin(), entries.end());
  result.factor_ = std::make_unique<const NormalFactor::Factor>(lower);
  if (result.factor_->info() != Eigen::Success) return std::nullopt;
  return result;
}

std::optional<Eigen::MatrixXd> NormalFactor::Solve(const Eigen::MatrixXd& right,
                                                   int threads) const {
  assert(right.cols() == scale_.size());
  Eigen::MatrixXd solutions(right.rows(), right.cols());
  ParallelFor(static_cast<size_t>(right.rows()), threads, [&](size_t i) {
    const auto row = static_cast<Eigen::Index>(i);
    const Eigen::VectorXd scaled = scale_.cwiseProduct(right.row(row).transpose());
    solutions.row(row) = scale_.cwiseProduct(factor_->solve(scaled).eval()).transpose();
  });
  if (!solutions.allFinite()) return std::nullopt;
  return solutions;
}

}  // namespace stucco
