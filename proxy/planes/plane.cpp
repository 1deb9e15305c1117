// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/planes/plane.h"

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>

#include "proxy/planes/densest.h"

namespace stucco {
namespace {

// Of the plane's points along its normal, in one order of summing on every library.
std::vector<double> SortedOffsets(const Samples& samples, const Plane& plane) {
  std::vector<double> offsets;
  offsets.reserve(plane.points.size());
  for (const int i : plane.points) offsets.push_back(plane.normal.dot(samples.positions[i]));
  std::sort(offsets.begin(), offsets.end());
  return offsets;
}

}  // namespace

Eigen::Vector3d AnyPerpendicular(const Eigen::Vector3d& direction) {
  int axis = 0;
  direction.cwiseAbs().minCoeff(&axis);
  return direction.cross(Eigen::Vector3d::Unit(axis)).normalized();
}

PlaneFrame FrameOf(const Plane& plane, const Eigen::Vector3d& up,
                   const Eigen::Vector3d& main_direction, const Eigen::Vector3d& near) {
  constexpr double kSinOfFlat = 0.02;  // below about one degree "horizontal in it" means nothing
  PlaneFrame frame;
  Eigen::Vector3d u = up.cross(plane.normal);
  if (u.norm() < kSinOfFlat) u = main_direction - plane.normal * plane.normal.dot(main_direction);
  if (u.norm() < kSinOfFlat) u = AnyPerpendicular(plane.normal);
  frame.u = u.normalized();
  frame.v = plane.normal.cross(frame.u);
  frame.origin = near - plane.normal * plane.DistanceTo(near);
  return frame;
}

void Refit(const Samples& samples, Plane& plane) {
  if (plane.points.size() < 3) return;
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const int i : plane.points) mean += samples.positions[i];
  mean /= static_cast<double>(plane.points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const int i : plane.points) {
    const Eigen::Vector3d d = samples.positions[i] - mean;
    covariance += d * d.transpose();
  }
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(covariance);
  Eigen::Vector3d normal = solver.eigenvectors().col(0);
  if (normal.dot(plane.normal) < 0) normal = -normal;
  plane.normal = normal;
  plane.offset = normal.dot(mean);
}

void RefitOffset(const Samples& samples, double epsilon, Plane& plane) {
  if (plane.points.empty()) return;
  const std::vector<double> offsets = SortedOffsets(samples, plane);
  const double median = offsets[offsets.size() / 2];
  double sum = 0;
  int count = 0;
  for (const double offset : offsets) {
    if (std::abs(offset - median) > epsilon) continue;
    sum += offset;
    ++count;
  }
  plane.offset = sum / count;
}

void RefitToDensest(const Samples& samples, double width, Plane& plane) {
  if (plane.points.empty()) return;
  plane.offset = MeanOfDensest(SortedOffsets(samples, plane), width);
}

void Measure(const Samples& samples, double cell, Plane& plane) {
  const Eigen::Vector3d u = AnyPerpendicular(plane.normal);
  const Eigen::Vector3d v = plane.normal.cross(u);
  std::vector<uint64_t> cells;
  cells.reserve(plane.points.size());
  double squares = 0;
  for (const int i : plane.points) {
    const Eigen::Vector3d& p = samples.positions[i];
    const auto x = static_cast<int32_t>(std::floor(u.dot(p) / cell));
    const auto y = static_cast<int32_t>(std::floor(v.dot(p) / cell));
    cells.push_back(uint64_t{static_cast<uint32_t>(x)} << 32 | static_cast<uint32_t>(y));
    squares += plane.DistanceTo(p) * plane.DistanceTo(p);
  }
  std::sort(cells.begin(), cells.end());
  const auto distinct = std::unique(cells.begin(), cells.end()) - cells.begin();
  plane.area = static_cast<double>(distinct) * cell * cell;
  plane.rms = plane.points.empty() ? 0 : std::sqrt(squares / double(plane.points.size()));
}

}  // namespace stucco
