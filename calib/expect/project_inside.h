// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "survey/camera.h"

namespace stucco {

// Where the picture shows a point in the camera's frame; nothing where it does not, or where the
// distortion polynomial folds back what lies far outside.
inline std::optional<Eigen::Vector2d> ProjectInside(const Camera& camera,
                                                    const Eigen::Vector3d& in_cam) {
  if (in_cam.z() <= 0 || !camera.IsInvertibleAt(in_cam.hnormalized())) return std::nullopt;
  const auto pixel = camera.Project(in_cam);
  return pixel && camera.Contains(*pixel) ? pixel : std::nullopt;
}

}  // namespace stucco
