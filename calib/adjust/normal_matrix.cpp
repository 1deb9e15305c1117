// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/adjust/internal/normal_matrix.h"

#include <Eigen/Cholesky>
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <random>

#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr double kRounding = 1e-10;  // of what holds an unknown while all others are held

using SparseMatrix = Eigen::SparseMatrix<double>;

// Plus and minus one at random: the outer product with itself is the unit matrix in the mean.
Eigen::VectorXd RandomSigns(Eigen::Index size, size_t seed) {
  std::mt19937 random(static_cast<uint32_t>(seed));
  Eigen::VectorXd signs(size);
  for (double& sign : signs) sign = (random() & 1u) != 0 ? 1 : -1;
  return signs;
}

}  // namespace

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

std::optional<Eigen::VectorXd> NormalMatrix::ScaleToOnes() const {
  const Eigen::VectorXd scale = Diagonal().cwiseSqrt().cwiseInverse();
  if (!scale.allFinite()) return std::nullopt;
  return scale;
}

std::optional<Eigen::MatrixXd> NormalMatrix::HalfInverse(int threads) const {
  const auto scale = ScaleToOnes();
  if (!scale) return std::nullopt;
  const int size = static_cast<int>(diagonal_.size());
  Eigen::MatrixXd factor = diagonal_.asDiagonal();
  for (const Block& block : blocks_) {
    factor.block(block.row, block.col, block.values.rows(), block.values.cols()) += block.values;
  }
  factor = scale->asDiagonal() * factor * scale->asDiagonal();
  factor.diagonal().array() += kRounding;
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> factors(factor);
  if (factors.info() != Eigen::Success) return std::nullopt;
  constexpr int kColumns = 96;
  Eigen::MatrixXd half = Eigen::MatrixXd::Zero(size, size);
  ParallelFor((size + kColumns - 1) / kColumns, threads, [&](size_t block) {
    const int begin = static_cast<int>(block) * kColumns;
    const int count = std::min(kColumns, size - begin);
    const int below = size - begin;
    auto columns = half.block(begin, begin, below, count);
    columns.topRows(count).setIdentity();
    factor.bottomRightCorner(below, below).triangularView<Eigen::Lower>().solveInPlace(columns);
  });
  half = half * scale->asDiagonal();
  if (!half.allFinite()) return std::nullopt;
  return half;
}

std::optional<Eigen::MatrixXd> NormalMatrix::SampledHalfInverse(int rows, int threads) const {
  const auto scale = ScaleToOnes();
  if (!scale) return std::nullopt;
  const Eigen::Index size = diagonal_.size();
  std::vector<Eigen::Triplet<double>> entries;
  const auto add = [&](Eigen::Index row, Eigen::Index col, double value) {
    entries.emplace_back(row, col, (*scale)[row] * value * (*scale)[col]);
  };
  for (Eigen::Index i = 0; i < size; ++i) {
    entries.emplace_back(i, i, (*scale)[i] * diagonal_[i] * (*scale)[i] + kRounding);
  }
  for (const Block& block : blocks_) {
    for (Eigen::Index col = 0; col < block.values.cols(); ++col) {
      for (Eigen::Index row = block.row == block.col ? col : 0; row < block.values.rows(); ++row) {
        add(block.row + row, block.col + col, block.values(row, col));
      }
    }
  }
  SparseMatrix lower(size, size);
  lower.setFromTriplets(entries.begin(), entries.end());
  const Eigen::SimplicialLLT<SparseMatrix, Eigen::Lower> factors(lower);
  if (factors.info() != Eigen::Success) return std::nullopt;
  Eigen::MatrixXd half(rows, size);
  ParallelFor(rows, threads, [&](size_t row) {
    const Eigen::VectorXd drawn = factors.matrixU().solve(RandomSigns(size, row));
    half.row(static_cast<Eigen::Index>(row)) =
        (scale->cwiseProduct(factors.permutationPinv() * drawn) / std::sqrt(rows)).transpose();
  });
  if (!half.allFinite()) return std::nullopt;
  return half;
}

}  // namespace stucco
