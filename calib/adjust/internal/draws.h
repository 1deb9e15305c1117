// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

namespace stucco {

// Draws of right sides of normal equations, a row each: sums of what the terms of the equations say
// when their errors have signs at random. Solved, they scatter as what the equations determine
// does: by the spread of the errors themselves, whatever each one's size (Wu, "Jackknife, bootstrap
// and other resampling methods in regression analysis", 1986; of estimating equations: Hu and
// Kalbfleisch, "The estimating function bootstrap", 2000).
class Draws {
 public:
  static constexpr int kCount = 256;  // deviations that they show are good to some 4 %
  using Signs = Eigen::Matrix<double, kCount, 1>;

  explicit Draws(int size) : rows_(Eigen::MatrixXd::Zero(kCount, size)) {}

  // Plus and minus one, the same for the same key.
  static Signs SignsOf(uint64_t key);

  // Of unknowns from `at` on, a column each.
  void Add(int at, const Eigen::Ref<const Eigen::MatrixXd>& columns) {
    rows_.middleCols(at, columns.cols()) += columns;
  }
  // Of errors with the same sign.
  void Add(int at, const Signs& signs, const Eigen::Ref<const Eigen::VectorXd>& error) {
    rows_.middleCols(at, error.size()) += signs * error.transpose();
  }
  const Eigen::MatrixXd& rows() const { return rows_; }

 private:
  Eigen::MatrixXd rows_;
};

}  // namespace stucco
