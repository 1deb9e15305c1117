// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "proxy/cloud/samples.h"

namespace stucco {

enum class PlaneRole {
  kFree,        // up is not known yet
  kWall,        // vertical
  kSlope,       // pitched roof
  kHorizontal,  // flat, looking up
  kCeiling,     // flat, looking down
};

// A plane of the scene with the samples that lie on it. normal . x = offset, `normal` towards the
// cameras.
struct Plane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;
  std::vector<int> points;  // indices into Samples, ascending
  double area = 0;          // covered by its points
  double rms = 0;
  PlaneRole role = PlaneRole::kFree;

  double DistanceTo(const Eigen::Vector3d& point) const { return normal.dot(point) - offset; }
};

// Right-handed frame in a plane: u x v = normal. On walls and roofs u is horizontal and v points
// upwards; on horizontal planes u is `main_direction` laid into the plane.
struct PlaneFrame {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v = Eigen::Vector3d::UnitY();

  Eigen::Vector2d ToPlane(const Eigen::Vector3d& p) const {
    return {u.dot(p - origin), v.dot(p - origin)};
  }
  Eigen::Vector3d ToWorld(const Eigen::Vector2d& p) const { return origin + p.x() * u + p.y() * v; }
};

PlaneFrame FrameOf(const Plane& plane, const Eigen::Vector3d& up,
                   const Eigen::Vector3d& main_direction, const Eigen::Vector3d& near);

// Least-squares plane through the plane's points; keeps the side its normal points to. Planes with
// fewer than 3 points stay as they are.
void Refit(const Samples& samples, Plane& plane);

// With the normal held: offset from the median, then the mean of the points within `epsilon`.
void RefitOffset(const Samples& samples, double epsilon, Plane& plane);

// With the normal held: to where its points lie closest together, within `width`. A wall is drawn
// back by its windows, and a flat roof up by the rim of its parapet.
void RefitToDensest(const Samples& samples, double width, Plane& plane);

// Sets rms and area (cells of side `cell` with a point).
void Measure(const Samples& samples, double cell, Plane& plane);

// Any unit vector perpendicular to `direction`, the same on every run.
Eigen::Vector3d AnyPerpendicular(const Eigen::Vector3d& direction);

}  // namespace stucco
