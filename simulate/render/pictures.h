// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

namespace stucco::simulate {

// Linear radiance, rows without padding, R G B interleaved; 1 is a white surface in the sun.
struct Radiance {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> rgb;
};

// A picture plane for views without perspective: texel (column c, row r) looks along -normal at
// origin + (c + 0.5) * metres_per_texel * u_axis + (r + 0.5) * metres_per_texel * v_axis, as in
// TexturedFacet; normal = v_axis x u_axis points at the viewer.
struct PicturePlane {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();
  Eigen::Vector3d u_axis = Eigen::Vector3d::UnitX();
  Eigen::Vector3d v_axis = -Eigen::Vector3d::UnitZ();
  double metres_per_texel = 0.01;
  int width_px = 0;
  int height_px = 0;
  double from_m = 3;  // the rays start this far before the plane: nothing nearer is seen
  double to_m = 3;    // and end this far behind it
};

struct RayHit {
  Eigen::Vector3d point;
  Eigen::Vector3d normal;  // unit, towards the origin of the ray
  double distance = 0;
  int element = -1;
};

// Which elements a picture leaves out, though not their shade: by default none.
struct RenderOptions {
  int threads = 0;             // 0: all
  std::vector<bool> left_out;  // by element; empty: none
};

}  // namespace stucco::simulate
