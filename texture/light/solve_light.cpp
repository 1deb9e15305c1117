// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/solve_light.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "survey/median.h"

namespace stucco {
namespace {

// Deviations, of logarithms of colours: of a measured ratio with many texels, of a photo's gain and
// of a falloff's terms from nothing.
constexpr double kRatioSigma = 0.02;
constexpr double kGainSigma = 0.5;
constexpr double kFalloffSigma = 0.25;
constexpr double kManyTexels = 200;
constexpr double kHuberWidth = 0.06;
constexpr int kSolveRounds = 8;
constexpr double kSignificant = 3;  // of its own standard deviation

// Hues of gains farther from the middle of all than both: logarithms, and times the median
// distance.
constexpr double kAlwaysLikely = 0.05;
constexpr double kFarFromUsual = 4;

// A tree or a car before most of what a photo shows makes its ratios those of leaves to plaster; a
// camera's white balance does no such thing to one photo. Hues that are far from those of the other
// photos in `logs` come back to where they are still likely.
void LimitHues(const std::vector<size_t>& compared, std::vector<Eigen::Vector3d>& logs) {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int k = 0; k < 3; ++k) {
    std::vector<double> values;
    values.reserve(compared.size());
    for (const size_t i : compared) values.push_back(HueOf(logs[i])[k]);
    middle[k] = Median(std::move(values)).value_or(0);
  }
  std::vector<double> apart;
  apart.reserve(compared.size());
  for (const size_t i : compared) apart.push_back((HueOf(logs[i]) - middle).norm());
  const double most = std::max(kAlwaysLikely, kFarFromUsual * Median(apart).value_or(0));
  for (size_t n = 0; n < compared.size(); ++n) {
    if (!(apart[n] > most)) continue;
    Eigen::Vector3d& log = logs[compared[n]];
    const Eigen::Vector3d hue = middle + (HueOf(log) - middle) * (most / apart[n]);
    log = hue.array() + (log.mean() - hue.mean());
  }
}

// What one ratio says: log a + falloff a - log b - falloff b = measured.
struct Equation {
  int a = -1;
  int b = -1;
  double measured = 0;
  double weight = 0;  // texels
  // Of the falloffs: unknown and factor, those of a, then those of b.
  std::array<std::pair<int, double>, 4> falloff = {};
};

// Unknowns are the logarithms of the photos' light, then two terms for each lens.
struct Unknowns {
  Eigen::Index photos = 0;
  Eigen::Index lenses = 0;  // 0: falloffs are no part

  Eigen::Index size() const { return photos + 2 * lenses; }
};

struct Solution {
  Eigen::VectorXd values;
  // Variances of each lens's loss in the corner, by lens.
  std::vector<double> corner_variance;
};

using Factors = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>;

double Residual(const Equation& equation, const Unknowns& unknowns, const Eigen::VectorXd& values) {
  double sum = values[equation.a] - values[equation.b] - equation.measured;
  if (unknowns.lenses == 0) return sum;
  for (const auto& [unknown, factor] : equation.falloff) sum += factor * values[unknown];
  return sum;
}

Solution Solve(std::span<const Equation> equations, const Unknowns& unknowns) {
  Solution solution{Eigen::VectorXd::Zero(unknowns.size()), {}};
  Factors factors;
  for (int round = 0; round < kSolveRounds; ++round) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(unknowns.size());
    for (Eigen::Index i = 0; i < unknowns.size(); ++i) {
      const double sigma = i < unknowns.photos ? kGainSigma : kFalloffSigma;
      entries.emplace_back(i, i, 1 / (sigma * sigma));
    }
    for (const Equation& equation : equations) {
      const double residual = Residual(equation, unknowns, solution.values);
      const double huber = std::min(1.0, kHuberWidth / std::max(1e-12, std::abs(residual)));
      const double weight =
          huber * std::min(1.0, equation.weight / kManyTexels) / (kRatioSigma * kRatioSigma);
      std::vector<std::pair<int, double>> row = {{equation.a, 1.0}, {equation.b, -1.0}};
      if (unknowns.lenses > 0) {
        row.insert(row.end(), equation.falloff.begin(), equation.falloff.end());
      }
      for (const auto& [i, factor] : row) {
        for (const auto& [j, other] : row) entries.emplace_back(i, j, weight * factor * other);
        right[i] += weight * factor * equation.measured;
      }
    }
    Eigen::SparseMatrix<double> normal(unknowns.size(), unknowns.size());
    normal.setFromTriplets(entries.begin(), entries.end());
    factors.compute(normal);
    solution.values = factors.solve(right);
  }
  for (Eigen::Index lens = 0; lens < unknowns.lenses; ++lens) {
    Eigen::VectorXd corner = Eigen::VectorXd::Zero(unknowns.size());
    corner.segment<2>(unknowns.photos + 2 * lens).setOnes();
    solution.corner_variance.push_back(corner.dot(factors.solve(corner)));
  }
  return solution;
}

std::vector<Falloff> FalloffsOfLenses(std::span<const ColourRatio> ratios,
                                      std::span<const int> camera_of_photo) {
  const auto photos = static_cast<int>(camera_of_photo.size());
  const int lenses = 1 + std::ranges::max(camera_of_photo);
  std::vector<Equation> equations;
  equations.reserve(ratios.size());
  for (const ColourRatio& ratio : ratios) {
    const int of_a = photos + 2 * camera_of_photo[ratio.a];
    const int of_b = photos + 2 * camera_of_photo[ratio.b];
    equations.push_back({ratio.a,
                         ratio.b,
                         ratio.log_ratio.mean(),
                         ratio.weight,
                         {{{of_a, ratio.corner_a[0]},
                           {of_a + 1, ratio.corner_a[1]},
                           {of_b, -ratio.corner_b[0]},
                           {of_b + 1, -ratio.corner_b[1]}}}});
  }
  const Solution solution = Solve(equations, {photos, lenses});
  std::vector<Falloff> falloffs(lenses);
  for (int lens = 0; lens < lenses; ++lens) {
    const Falloff found{solution.values.segment<2>(photos + 2 * lens)};
    const double sigma = std::sqrt(solution.corner_variance[lens]);
    if (std::abs(found.LogAt(1)) > kSignificant * sigma) falloffs[lens] = found;
  }
  return falloffs;
}

// Logarithms of the photos' gains, with their lenses' falloffs taken off.
std::vector<Eigen::Vector3d> LogGains(std::span<const ColourRatio> ratios,
                                      std::span<const Falloff> falloffs) {
  std::vector<Eigen::Vector3d> logs(falloffs.size(), Eigen::Vector3d::Zero());
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<Equation> equations;
    equations.reserve(ratios.size());
    for (const ColourRatio& ratio : ratios) {
      const double lost =
          falloffs[ratio.a].terms.dot(ratio.corner_a) - falloffs[ratio.b].terms.dot(ratio.corner_b);
      equations.push_back({ratio.a, ratio.b, ratio.log_ratio[channel] - lost, ratio.weight});
    }
    const Solution solution = Solve(equations, {static_cast<Eigen::Index>(logs.size()), 0});
    for (size_t i = 0; i < logs.size(); ++i) {
      logs[i][channel] = -solution.values[static_cast<Eigen::Index>(i)];
    }
  }
  return logs;
}

}  // namespace

PhotosLight SolveLight(std::span<const ColourRatio> ratios, std::span<const int> camera_of_photo) {
  const size_t photos = camera_of_photo.size();
  assert(std::ranges::all_of(ratios, [&](const ColourRatio& ratio) {
    return static_cast<size_t>(std::max(ratio.a, ratio.b)) < photos;
  }));
  PhotosLight light{std::vector<Eigen::Vector3d>(photos, Eigen::Vector3d::Ones()),
                    std::vector<Falloff>(photos)};
  if (ratios.empty()) return light;
  const std::vector<Falloff> lenses = FalloffsOfLenses(ratios, camera_of_photo);
  for (size_t i = 0; i < photos; ++i) light.falloffs[i] = lenses[camera_of_photo[i]];
  std::vector<Eigen::Vector3d> logs = LogGains(ratios, light.falloffs);
  std::vector<uint8_t> is_compared(photos, 0);
  for (const ColourRatio& ratio : ratios) is_compared[ratio.a] = is_compared[ratio.b] = 1;
  std::vector<size_t> compared;
  for (size_t i = 0; i < photos; ++i) {
    if (is_compared[i]) compared.push_back(i);
  }
  LimitHues(compared, logs);
  for (const size_t i : compared) light.gains[i] = GainOf(logs[i]);
  return light;
}

}  // namespace stucco
