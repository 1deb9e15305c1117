// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/render/light.h"
#include "simulate/scene/scene.h"
#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco::simulate {

// Linear radiance, rows without padding, R G B interleaved; 1 is a white surface in the sun.
struct Radiance {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> rgb;
};

// Distance along the camera's z axis in metres, 0 where there is only sky.
struct DepthMap {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> depth_m;
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

// Draws a scene by ray casting (Embree): textures through anisotropic mip maps, edges and shadow
// lines by more rays where neighbouring rays differ, sunlight with shadows, sky light by how much
// of the sky a place sees. Thread-safe; the same picture at any number of threads.
class Renderer {
 public:
  explicit Renderer(Scene scene);
  ~Renderer();
  Renderer(Renderer&&) noexcept;
  Renderer& operator=(Renderer&&) noexcept;

  const Scene& scene() const;

  // Finds how much of the sky each place sees, on all threads. The first lit picture does it
  // otherwise; where pictures are drawn in parallel, all would wait for the one thread of that one.
  void PrepareLight() const;

  // What a perfect lens with the distortion of `camera` shows.
  Radiance Photograph(const Camera& camera, const Pose& cam_from_world, const Light& light,
                      const RenderOptions& options = {}) const;
  Radiance Flatten(const PicturePlane& plane, const Light& light,
                   const RenderOptions& options = {}) const;
  // Rays through pixel centres.
  DepthMap Depth(const Camera& camera, const Pose& cam_from_world,
                 const RenderOptions& options = {}) const;
  std::optional<RayHit> Cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stucco::simulate
