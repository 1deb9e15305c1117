// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/light/colour.h"

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

Eigen::Vector3d HueOf(const Eigen::Vector3d& logs) {
  return logs.array() - logs.mean();
}

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
  std::vector<Eigen::Vector3d> logs(photos, Eigen::Vector3d::Zero());
  for (int channel = 0; channel < 3; ++channel) {
    const Eigen::VectorXd log_gain = SolveChannel(ratios, photos, channel);
    for (size_t i = 0; i < photos; ++i) logs[i][channel] = log_gain[static_cast<Eigen::Index>(i)];
  }
  std::vector<uint8_t> is_compared(photos, 0);
  for (const ColourRatio& ratio : ratios) is_compared[ratio.a] = is_compared[ratio.b] = 1;
  std::vector<size_t> compared;
  for (size_t i = 0; i < photos; ++i) {
    if (is_compared[i]) compared.push_back(i);
  }
  LimitHues(compared, logs);
  for (const size_t i : compared) {
    gains[i] = logs[i].array().exp().max(1 / kLargestGain).min(kLargestGain);
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
  std::vector<double> apart;
  for (const ColourRatio& ratio : ratios) {
    apart.push_back((HueOf(ratio.log_ratio) - HueOf(log_ratio)).norm());
  }
  if (ratios.size() < kFewestFacets || *Median(std::move(apart)) > kAgreeingHues) {
    log_ratio.setConstant(log_ratio.mean());
  }
  return (-log_ratio).array().exp().min(kLargestGain).max(1 / kLargestGain);
}

}  // namespace stucco
