// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/colour.h"

#include <Eigen/SparseCholesky>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

#include "survey/median.h"

namespace stucco {
namespace {

constexpr float kDarkest = 12;     // below, noise and black clipping change ratios
constexpr float kBrightest = 245;  // above, clipped
constexpr size_t kFewestTexels = 24;
// Deviations: of a measured log ratio with many texels, and of a photo's gain from 1.
constexpr double kRatioSigma = 0.02;
constexpr double kGainSigma = 0.5;
constexpr double kManyTexels = 200;
constexpr double kHuberWidth = 0.06;
constexpr int kRounds = 8;
constexpr double kLargestGain = 4;
constexpr size_t kFewestFacets = 3;  // of which one may have another colour
// Hues of facets that lie farther apart than this, in the middle, have no white balance in common:
// logarithms of encoded colours, about what eyes see beside each other.
constexpr double kAgreeingHues = 0.05;

// One channel: log gains.
Eigen::VectorXd SolveChannel(std::span<const ColourRatio> ratios, size_t photos, int channel) {
  const auto count = static_cast<Eigen::Index>(photos);
  Eigen::VectorXd log_gain = Eigen::VectorXd::Zero(count);
  for (int round = 0; round < kRounds; ++round) {
    std::vector<Eigen::Triplet<double>> entries;
    Eigen::VectorXd right = Eigen::VectorXd::Zero(count);
    for (Eigen::Index i = 0; i < count; ++i) {
      entries.emplace_back(i, i, 1 / (kGainSigma * kGainSigma));
    }
    for (const ColourRatio& ratio : ratios) {
      const double difference = log_gain[ratio.a] - log_gain[ratio.b] + ratio.log_ratio[channel];
      const double huber = std::min(1.0, kHuberWidth / std::max(1e-12, std::abs(difference)));
      const double weight =
          huber * std::min(1.0, ratio.weight / kManyTexels) / (kRatioSigma * kRatioSigma);
      entries.emplace_back(ratio.a, ratio.a, weight);
      entries.emplace_back(ratio.b, ratio.b, weight);
      entries.emplace_back(ratio.a, ratio.b, -weight);
      entries.emplace_back(ratio.b, ratio.a, -weight);
      right[ratio.a] -= weight * ratio.log_ratio[channel];
      right[ratio.b] += weight * ratio.log_ratio[channel];
    }
    Eigen::SparseMatrix<double> normal(count, count);
    normal.setFromTriplets(entries.begin(), entries.end());
    log_gain = Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(normal).solve(right);
  }
  return log_gain;
}

}  // namespace

std::optional<ColourRatio> MeasureRatio(int a, int b, std::span<const float> rgb_a,
                                        std::span<const float> rgb_b,
                                        std::span<const uint8_t> both_show) {
  std::vector<double> logs[3];
  const auto usable = [](const float* rgb) {
    return std::min({rgb[0], rgb[1], rgb[2]}) > kDarkest &&
           std::max({rgb[0], rgb[1], rgb[2]}) < kBrightest;
  };
  for (size_t i = 0; i < both_show.size(); ++i) {
    if (!both_show[i] || !usable(&rgb_a[3 * i]) || !usable(&rgb_b[3 * i])) continue;
    for (int k = 0; k < 3; ++k) {
      logs[k].push_back(std::log(static_cast<double>(rgb_a[3 * i + k]) / rgb_b[3 * i + k]));
    }
  }
  if (logs[0].size() < kFewestTexels) return std::nullopt;
  ColourRatio ratio{a, b};
  for (int k = 0; k < 3; ++k) ratio.log_ratio[k] = *Median(logs[k]);
  ratio.weight = static_cast<double>(logs[0].size());
  return ratio;
}

std::vector<Eigen::Vector3d> SolveGains(std::span<const ColourRatio> ratios, size_t photos) {
  std::vector<Eigen::Vector3d> gains(photos, Eigen::Vector3d::Ones());
  if (ratios.empty()) return gains;
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd log_gain = SolveChannel(ratios, photos, channel);
    for (size_t i = 0; i < photos; ++i) {
      gains[i][channel] = std::clamp(std::exp(log_gain[static_cast<Eigen::Index>(i)]),
                                     1 / kLargestGain, kLargestGain);
    }
  }
  return gains;
}

Eigen::Vector3d CommonGain(std::span<const ColourRatio> ratios) {
  Eigen::Vector3d log_ratio = Eigen::Vector3d::Zero();
  for (int channel = 0; channel < 3; ++channel) {
    std::vector<double> values;
    for (const ColourRatio& ratio : ratios) values.push_back(ratio.log_ratio[channel]);
    log_ratio[channel] = Median(std::move(values)).value_or(0);
  }
  const auto hue_of = [](const Eigen::Vector3d& v) {
    return Eigen::Vector3d(v.array() - v.mean());
  };
  std::vector<double> apart;
  for (const ColourRatio& ratio : ratios) {
    apart.push_back((hue_of(ratio.log_ratio) - hue_of(log_ratio)).norm());
  }
  if (ratios.size() < kFewestFacets || *Median(std::move(apart)) > kAgreeingHues) {
    log_ratio.setConstant(log_ratio.mean());
  }
  return (-log_ratio).array().exp().min(kLargestGain).max(1 / kLargestGain);
}

}  // namespace stucco
