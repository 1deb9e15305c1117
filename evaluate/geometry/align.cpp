// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/align.h"

#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <random>

#include "survey/median.h"

namespace stucco::evaluate {
namespace {

using Eigen::Index;
using Eigen::Matrix3Xd;

constexpr int kTrials = 500;  // half the points wrong: three right ones but for (7/8)^500
constexpr int kRefinements = 10;
constexpr double kGross = 10;        // times the median: 1 in 1e20 of normal errors
constexpr double kExactM = 1e-9;     // where the median is rounding error, nothing is gross
constexpr double kOnOneLine = 1e-4;  // width of a set of points over its length

// Second singular value over the first, of the points about their mean.
bool SpansAPlane(const Matrix3Xd& points) {
  if (points.cols() < 3) return false;
  const Matrix3Xd centred = points.colwise() - points.rowwise().mean().eval();
  const Eigen::Vector3d sizes = Eigen::JacobiSVD<Eigen::Matrix3d>(centred * centred.transpose())
                                    .singularValues()
                                    .cwiseMax(0)
                                    .cwiseSqrt();
  return sizes[1] > kOnOneLine * sizes[0];
}

Eigen::VectorXd Residuals(const Similarity& fit, const Matrix3Xd& source, const Matrix3Xd& target) {
  Eigen::VectorXd residuals(source.cols());
  for (Index i = 0; i < source.cols(); ++i) {
    residuals[i] = (fit * Eigen::Vector3d(source.col(i)) - target.col(i)).norm();
  }
  return residuals;
}

double MedianOf(const Eigen::VectorXd& values) {
  return *Median(std::vector<double>(values.begin(), values.end()));
}

Matrix3Xd Columns(const Matrix3Xd& points, const std::vector<Index>& which) {
  return points(Eigen::all, which);
}

Similarity LeastMedian(const Matrix3Xd& source, const Matrix3Xd& target) {
  Similarity best = AlignPoints(source, target);
  double least = MedianOf(Residuals(best, source, target));
  std::mt19937_64 random(1);  // its numbers are the standard's, unlike those of distributions
  const auto count = static_cast<uint64_t>(source.cols());
  for (int trial = 0; trial < kTrials; ++trial) {
    std::vector<Index> sample(3);
    for (Index& i : sample) i = static_cast<Index>(random() % count);
    const Matrix3Xd from = Columns(source, sample), to = Columns(target, sample);
    if (!SpansAPlane(from) || !SpansAPlane(to)) continue;
    const Similarity fit = AlignPoints(from, to);
    const double median = MedianOf(Residuals(fit, source, target));
    if (median < least) {
      least = median;
      best = fit;
    }
  }
  return best;
}

}  // namespace

std::optional<Alignment> AlignRobustly(const Matrix3Xd& source, const Matrix3Xd& target) {
  assert(source.cols() == target.cols());
  if (!SpansAPlane(source) || !SpansAPlane(target)) return std::nullopt;
  Alignment alignment{LeastMedian(source, target), {}};
  for (int i = 0; i < kRefinements; ++i) {
    const Eigen::VectorXd residuals = Residuals(alignment.target_from_source, source, target);
    const double limit = std::max(kGross * MedianOf(residuals), kExactM);
    std::vector<bool> used;
    std::vector<Index> kept;
    for (Index k = 0; k < residuals.size(); ++k) {
      used.push_back(residuals[k] <= limit);
      if (used.back()) kept.push_back(k);
    }
    if (used == alignment.used) break;
    const Matrix3Xd from = Columns(source, kept), to = Columns(target, kept);
    if (!SpansAPlane(from) || !SpansAPlane(to)) return std::nullopt;
    alignment = {AlignPoints(from, to), used};
  }
  return alignment;
}

}  // namespace stucco::evaluate
