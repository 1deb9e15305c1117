// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/frustum.h"

#include <Eigen/Geometry>
#include <cmath>

namespace stucco {

bool Frustum::Contains(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d ray = point - position;
  const double depth = ray.dot(forward);
  return depth > 0 && ray.squaredNorm() <= reach_m * reach_m &&
         std::abs(ray.dot(right)) <= half_width * depth &&
         std::abs(ray.dot(down)) <= half_height * depth;
}

bool Frustum::MayTouch(const Eigen::Vector3d& box_min, const Eigen::Vector3d& box_max) const {
  const Eigen::Vector3d nearest = position.cwiseMax(box_min).cwiseMin(box_max);
  if ((nearest - position).squaredNorm() > reach_m * reach_m) return false;
  const Eigen::Vector3d center = 0.5 * (box_min + box_max) - position;
  const Eigen::Vector3d half = 0.5 * (box_max - box_min);
  // Outside one of the four sides with every corner.
  const auto inside = [&](const Eigen::Vector3d& inward) {
    return center.dot(inward) + half.dot(inward.cwiseAbs()) >= 0;
  };
  return inside(half_width * forward - right) && inside(half_width * forward + right) &&
         inside(half_height * forward - down) && inside(half_height * forward + down);
}

Eigen::Vector3d LookingDirection(double yaw_rad, double pitch_rad) {
  const double level = std::cos(pitch_rad);
  return {std::sin(yaw_rad) * level, std::cos(yaw_rad) * level, std::sin(pitch_rad)};
}

Frustum LevelFrustum(const FieldOfView& field, const Eigen::Vector3d& position, double yaw_rad,
                     double pitch_rad, double reach_m) {
  Frustum out;
  out.position = position;
  out.forward = LookingDirection(yaw_rad, pitch_rad);
  out.right = {std::cos(yaw_rad), -std::sin(yaw_rad), 0};
  out.down = out.forward.cross(out.right);
  out.half_width = field.half_width;
  out.half_height = field.half_height;
  out.reach_m = reach_m;
  return out;
}

}  // namespace stucco
