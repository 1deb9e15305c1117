// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "dense/view.h"
#include "survey/camera.h"
#include "survey/depth_map.h"
#include "survey/image.h"
#include "survey/pose.h"

namespace stucco::test {

// A textured rectangle: center + a * u + b * v with |a| <= half_width, |b| <= half_height.
struct MadePlane {
  Eigen::Vector3d center;
  Eigen::Vector3d u;  // unit vectors along the rectangle
  Eigen::Vector3d v;
  double half_width = 1e9;
  double half_height = 1e9;

  Eigen::Vector3d Normal() const { return u.cross(v).normalized(); }
  double Distance(const Eigen::Vector3d& point) const {
    return std::abs(Normal().dot(point - center));
  }
};

// 200 x 150 pixels, focal length 200.
Camera SmallCamera();

// Where the middle of `pixel` (array indices) meets the first plane: depth along the optical axis.
struct Hit {
  double depth = 0;
  const MadePlane* plane = nullptr;
};
std::optional<Hit> FirstHit(const PinholeCamera& view, const std::vector<MadePlane>& planes,
                            double x, double y);

// The planes as the view sees them, with detail down to two or three pixels; the background is
// evenly grey.
Image Render(const PinholeCamera& view, const std::vector<MadePlane>& planes);

// True depths and normals, cost 0.
DepthMap TrueDepths(const PinholeCamera& view, const std::vector<MadePlane>& planes);

// A slanted wall five metres before a camera in the origin that looks along +z.
MadePlane SlantedWall();
// Two walls that meet in an edge that points at that camera.
std::vector<MadePlane> TwoWalls();

// The camera in the origin and up to four others around it that look at the same place.
std::vector<Pose> PosesAround(int count);

// A photo as the stage has it after loading: three levels.
std::shared_ptr<const ViewPyramid> MadePyramid(const Pose& pose,
                                               const std::vector<MadePlane>& planes);

}  // namespace stucco::test
