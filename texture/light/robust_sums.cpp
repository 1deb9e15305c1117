// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/robust_sums.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace stucco {
namespace {

constexpr double kManyTexels = 200;
constexpr double kSumHuberWidth = 3;  // of its deviation
constexpr int kSumRounds = 8;

double Residual(const SumEquation& equation, const Eigen::VectorXd& values) {
  double sum = -equation.measured;
  for (const auto& [unknown, factor] : equation.terms) sum += factor * values[unknown];
  return sum;
}

// The normal equations of all.
struct Normal {
  explicit Normal(Eigen::Index unknowns) : right(Eigen::VectorXd::Zero(unknowns)) {}

  void Add(const SumEquation& equation, double weight) {
    for (const auto& [i, factor] : equation.terms) {
      if (factor == 0) continue;
      right[i] += weight * factor * equation.measured;
      for (const auto& [j, other] : equation.terms) {
        if (other != 0) entries.emplace_back(i, j, weight * factor * other);
      }
    }
  }

  std::vector<Eigen::Triplet<double>> entries;
  Eigen::VectorXd right;
};

}  // namespace

double LostToCorners(const ColourRatio& ratio, std::span<const Falloff> falloff_of_photo) {
  return falloff_of_photo[ratio.a].terms.dot(ratio.corner_a) -
         falloff_of_photo[ratio.b].terms.dot(ratio.corner_b);
}

SumEquation OfRatio(const ColourRatio& ratio, int a, int b, double measured, double sigma) {
  const double share = std::min(1.0, ratio.weight / kManyTexels);
  return {{{{a, 1.0}, {b, -1.0}}}, measured, sigma / std::sqrt(share)};
}

Eigen::VectorXd SolveSums(std::span<const SumEquation> equations,
                          const Eigen::VectorXd& prior_sigmas, NormalFactors& factors) {
  const Eigen::Index unknowns = prior_sigmas.size();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(unknowns);
  for (int round = 0; round < kSumRounds; ++round) {
    Normal normal(unknowns);
    for (int i = 0; i < unknowns; ++i) {
      normal.Add({.terms = {{{i, 1.0}}}}, 1 / (prior_sigmas[i] * prior_sigmas[i]));
    }
    for (const SumEquation& equation : equations) {
      const double deviations = std::abs(Residual(equation, values)) / equation.sigma;
      const double huber = std::min(1.0, kSumHuberWidth / std::max(1e-12, deviations));
      normal.Add(equation, huber / (equation.sigma * equation.sigma));
    }
    Eigen::SparseMatrix<double> matrix(unknowns, unknowns);
    matrix.setFromTriplets(normal.entries.begin(), normal.entries.end());
    factors.compute(matrix);
    values = factors.solve(normal.right);
  }
  return values;
}

}  // namespace stucco
