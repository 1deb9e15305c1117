// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/cloud/normals.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <utility>

#include "proxy/cloud/spread.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr size_t kBlock = 4096;  // samples a thread takes at once

template <typename Fn>
void ForEachSample(size_t count, int threads, Fn&& fn) {
  ParallelFor((count + kBlock - 1) / kBlock, threads, [&](size_t block) {
    const size_t end = std::min(count, (block + 1) * kBlock);
    for (size_t i = block * kBlock; i < end; ++i) fn(i);
  });
}

Eigen::Vector3d PlaneNormal(const Samples& samples, const GridIndex& index, size_t i,
                            double radius) {
  const Spread spread = SpreadAround(index, samples.positions[i], radius);
  if (spread.count < 3) return Eigen::Vector3d::UnitZ();
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(spread.covariance);
  return solver.eigenvectors().col(0);
}

Eigen::Vector3d Mean(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const Eigen::Vector3d& point : points) sum += point;
  return points.empty() ? sum : Eigen::Vector3d(sum / double(points.size()));
}

void FillMissing(Samples& samples, const GridIndex& index, double radius, int threads) {
  const Eigen::Vector3d mean_center = Mean(samples.camera_centers);
  const bool scanned = samples.camera_centers.empty();
  ForEachSample(samples.size(), threads, [&](size_t i) {
    if (samples.normals[i].squaredNorm() > 0.5) return;
    Eigen::Vector3d normal = PlaneNormal(samples, index, i, radius);
    const Eigen::Vector3d* eye = samples.EyeOf(i);
    const Eigen::Vector3d towards =
        scanned ? Eigen::Vector3d::UnitZ()
                : Eigen::Vector3d((eye != nullptr ? *eye : mean_center) - samples.positions[i]);
    if (normal.dot(towards) < 0) normal = -normal;
    samples.normals[i] = normal;
  });
}

}  // namespace

std::vector<double> SmoothNormals(Samples& samples, const GridIndex& index, double radius,
                                  int threads) {
  constexpr double kCosOfAlike = 0.707;
  FillMissing(samples, index, radius, threads);
  std::vector<double> agreement(samples.size(), 0);
  for (int round = 0; round < 2; ++round) {
    std::vector<Eigen::Vector3d> smoothed(samples.size());
    ForEachSample(samples.size(), threads, [&](size_t i) {
      Eigen::Vector3d sum = Eigen::Vector3d::Zero();
      int count = 0;
      index.ForEachNear(samples.positions[i], radius, [&](int j) {
        ++count;
        if (samples.normals[j].dot(samples.normals[i]) > kCosOfAlike) sum += samples.normals[j];
      });
      smoothed[i] = sum.normalized();
      if (round == 0) agreement[i] = count > 3 ? sum.norm() / count : 0;
    });
    samples.normals = std::move(smoothed);
  }
  return agreement;
}

}  // namespace stucco
