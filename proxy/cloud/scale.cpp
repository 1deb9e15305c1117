// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/scale.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/spread.h"
#include "survey/median.h"

namespace stucco {
namespace {

constexpr size_t kProbes = 3000;

Eigen::Vector3d SizeOfMiddle(const Samples& samples) {
  Eigen::Vector3d size;
  std::vector<double> values(samples.size());
  for (int axis = 0; axis < 3; ++axis) {
    for (size_t i = 0; i < samples.size(); ++i) values[i] = samples.positions[i][axis];
    std::sort(values.begin(), values.end());
    const size_t low = values.size() / 20;
    size[axis] = values[values.size() - 1 - low] - values[low];
  }
  return size;
}

double NearestDistance(const Samples& samples, const GridIndex& index, size_t i, double start) {
  double nearest = std::numeric_limits<double>::infinity();
  constexpr int kRounds = 6;  // farther than eight cells away a sample says nothing about spacing
  double radius = start;
  for (int round = 0; round < kRounds && !std::isfinite(nearest); ++round, radius *= 2) {
    index.ForEachNear(samples.positions[i], radius, [&](int j) {
      const double d = (samples.positions[j] - samples.positions[i]).norm();
      if (d > 0) nearest = std::min(nearest, d);
    });
  }
  return nearest;
}

// Root of the smallest eigenvalue of the neighbours' covariance; negative with too few neighbours.
double LocalNoise(const Samples& samples, const GridIndex& index, size_t i, double radius) {
  constexpr int kFewest = 8;
  const auto [count, covariance] = SpreadAround(index, samples.positions[i], radius);
  if (count < kFewest) return -1;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance, Eigen::EigenvaluesOnly);
  // A plane fitted to n points takes up three of the n degrees of freedom.
  return std::sqrt(std::max(0.0, solver.eigenvalues()[0]) * count / (count - 3));
}

}  // namespace

CloudScale MeasureScale(const Samples& samples) {
  assert(samples.size() >= 4);
  CloudScale scale;
  const Eigen::Vector3d size = SizeOfMiddle(samples);
  scale.extent = size.norm();
  if (!(scale.extent > 0)) return scale;
  const double guess = scale.extent / std::sqrt(static_cast<double>(samples.size()));
  const GridIndex index(samples.positions, guess);
  const size_t stride = std::max<size_t>(1, samples.size() / kProbes);
  std::vector<double> values;
  for (size_t i = 0; i < samples.size(); i += stride) {
    const double nearest = NearestDistance(samples, index, i, guess / 4);
    if (std::isfinite(nearest)) values.push_back(nearest);
  }
  scale.spacing = Median(values).value_or(0);
  values.clear();
  for (size_t i = 0; i < samples.size(); i += stride) {
    const double noise = LocalNoise(samples, index, i, 4 * scale.spacing);
    if (noise >= 0) values.push_back(noise);
  }
  scale.noise = Median(values).value_or(0);
  values.clear();
  for (size_t i = 0; i < samples.size(); i += stride) {
    const Eigen::Vector3d* eye = samples.EyeOf(i);
    if (eye != nullptr) values.push_back((*eye - samples.positions[i]).norm());
  }
  scale.viewing_distance = Median(values).value_or(0);
  return scale;
}

Tolerances DeriveTolerances(const CloudScale& scale, bool metric, const ProxyOptions& options) {
  // Without scale, photos of buildings are taken from some 40 m: 0.8 % of that is 0.3 m.
  constexpr double kDetail_m = 0.3;
  constexpr double kDetailPerDistance = 0.008;
  constexpr double kDetailPerExtent = 0.008;
  constexpr double kSpacingsPerDetail = 2;  // cells of the rasters are two spacings wide
  constexpr double kSpacingsPerGap = 6;
  constexpr double kSpacingsPerSide = 7;  // of the smallest facet
  constexpr double kDetails = 5;          // per gap, and per side
  Tolerances t;
  t.spacing = scale.spacing;
  t.level_of_detail = options.level_of_detail;
  if (t.level_of_detail <= 0) {
    t.level_of_detail = metric                       ? kDetail_m
                        : scale.viewing_distance > 0 ? kDetailPerDistance * scale.viewing_distance
                                                     : kDetailPerExtent * scale.extent;
    // Between samples farther apart than that what looks like noise is roofs beside the ground.
    const bool shows_noise = scale.spacing < t.level_of_detail;
    if (shows_noise) t.level_of_detail = std::max(t.level_of_detail, 3 * scale.noise);
  }
  const double wanted = t.level_of_detail;
  if (options.level_of_detail <= 0) {
    t.level_of_detail = std::max(wanted, kSpacingsPerDetail * scale.spacing);
  }
  t.coarseness = t.level_of_detail / wanted;
  const double gap = std::max(kDetails * wanted, kSpacingsPerGap * scale.spacing);
  const double side = std::max(kDetails * wanted, kSpacingsPerSide * scale.spacing);
  t.epsilon = options.epsilon > 0 ? options.epsilon : t.level_of_detail / 2;
  t.min_area = options.min_area > 0 ? options.min_area : side * side;
  t.fill_gap = options.fill_gap > 0 ? options.fill_gap : gap;
  t.radius = 3 * scale.spacing;
  return t;
}

int LeastPoints(const Tolerances& tolerances) {
  constexpr double kShare = 0.4;  // of the points that the smallest area has room for
  const double room = tolerances.min_area / (tolerances.spacing * tolerances.spacing);
  return static_cast<int>(std::clamp(kShare * room, 12.0, 60.0));
}

}  // namespace stucco
