// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/photo.h"

#include <algorithm>
#include <cmath>

namespace stucco {

void KnowLens(TexturePhoto& photo) {
  photo.safe_radius_squared = 0;
  double farthest = 0;
  for (int corner = 0; corner < 4; ++corner) {
    const auto ray = photo.camera.Unproject(
        {(corner % 2) * photo.camera.width_px * 1.0, (corner / 2) * photo.camera.height_px * 1.0});
    if (!ray) return;
    farthest = std::max(farthest, ray->squaredNorm());
  }
  const Eigen::Vector2d edge(std::sqrt(farthest), 0);
  if (photo.camera.IsInvertibleAt(edge)) photo.safe_radius_squared = farthest;
}

std::optional<Eigen::Vector2d> ProjectIntoPhoto(const TexturePhoto& photo,
                                                const Eigen::Vector3d& point_in_world) {
  const Eigen::Vector3d point_in_cam = photo.cam_from_world * point_in_world;
  if (!(point_in_cam.z() > 0)) return std::nullopt;
  const Eigen::Vector2d ray = point_in_cam.head<2>() / point_in_cam.z();
  const Eigen::Vector2d pixel = photo.camera.Distort(ray);
  if (!photo.camera.Contains(pixel)) return std::nullopt;
  if (ray.squaredNorm() > photo.safe_radius_squared && !photo.camera.IsInvertibleAt(ray)) {
    return std::nullopt;
  }
  return pixel;
}

}  // namespace stucco
