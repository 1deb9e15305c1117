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

}  // namespace

SumEquation OfRatio(const ColourRatio& ratio, int a, int b, double measured, double sigma) {
  const double share = std::min(1.0, ratio.weight / kManyTexels);
  return {{{{a, 1.0}, {b, -1.0}}}, measured, sigma / std::sqrt(share)};
}

Eigen::VectorXd SolveSums(std::span<const SumEquation> equations,
                          const Eigen::VectorXd& prior_sigmas, NormalFactors& factors) {
  const Eigen::Index unknowns = prior_sigmas.size();
  Eigen::VectorXd values = Eigen::VectorXd::Zero(unknowns);
  for (int round = 0; round < kSumRounds; ++round) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns);
    for (int i = 0; i < unknowns; ++i) {
      entries.emplace_back(i, i, 1 / (prior_sigmas[i] * prior_sigmas[i]));
    }
    for (const SumEquation& equation : equations) {
      const double deviations = std::abs(Residual(equation, values)) / equation.sigma;
      const double weight = std::min(1.0, kSumHuberWidth / std::max(1e-12, deviations)) /
                            (equation.sigma * equation.sigma);
      for (const auto& [i, factor] : equation.terms) {
        if (factor == 0) continue;
        for (const auto& [j, other] : equation.terms) {
          if (other != 0) entries.emplace_back(i, j, weight * factor * other);
        }
        right[i] += weight * factor * equation.measured;
      }
    }
    Eigen::SparseMatrix<double> normal(unknowns, unknowns);
    normal.setFromTriplets(entries.begin(), entries.end());
    factors.compute(normal);
    values = factors.solve(right);
  }
  return values;
}

}  // namespace stucco
