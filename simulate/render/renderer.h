// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "simulate/render/light.h"
#include "simulate/render/pictures.h"
#include "simulate/scene/scene.h"
#include "survey/camera.h"
#include "survey/depth_map.h"
#include "survey/pose.h"

namespace stucco::simulate {

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
  // How far what each texel of Flatten shows lies before the plane (behind: negative), in metres;
  // NaN where there is nothing.
  std::vector<float> Heights(const PicturePlane& plane, const RenderOptions& options = {}) const;
  // Distance along the camera's z axis in metres on rays through pixel centres, 0 where there is
  // only sky; no normals, and costs of 0.
  DepthMap Depth(const Camera& camera, const Pose& cam_from_world,
                 const RenderOptions& options = {}) const;
  std::optional<RayHit> Cast(const Eigen::Vector3d& from, const Eigen::Vector3d& direction) const;

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace stucco::simulate
