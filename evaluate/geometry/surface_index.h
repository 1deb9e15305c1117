// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "evaluate/geometry/surface.h"

namespace stucco::evaluate {

// The place of a surface that is nearest to a point.
struct NearestPlace {
  double distance = std::numeric_limits<double>::infinity();
  Eigen::Vector3d place = Eigen::Vector3d::Zero();
  int group = 0;  // of its triangle
};

// Distances to a surface and lines of sight past it, through Embree's tree. Thread-safe.
class SurfaceIndex {
 public:
  // Requires triangles of the surface's vertices, each with a group.
  explicit SurfaceIndex(Surface surface);
  ~SurfaceIndex();
  SurfaceIndex(SurfaceIndex&&) noexcept;
  SurfaceIndex& operator=(SurfaceIndex&&) noexcept;

  const Surface& surface() const;
  // The nearest point of any triangle, in double precision; infinitely far where there are none.
  NearestPlace Nearest(const Eigen::Vector3d& point) const;
  double Distance(const Eigen::Vector3d& point) const { return Nearest(point).distance; }
  // Whether the straight line between two points meets a triangle. Coordinates are rounded to
  // floats: leave a few millimetres to the surfaces on which the points lie.
  bool Blocked(const Eigen::Vector3d& from, const Eigen::Vector3d& to) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

std::vector<double> Distances(std::span<const Eigen::Vector3d> points, const SurfaceIndex& index,
                              int threads);

}  // namespace stucco::evaluate
