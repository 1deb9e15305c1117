// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/camera/hover.h"

namespace stucco::plan {

Eigen::Vector3d Shot::Direction() const {
  return LookingDirection(yaw_rad, pitch_rad);
}

Viewpoint ViewpointOf(const FieldOfView& field, const Hover& hover, double reach_m) {
  Viewpoint out{hover.position, {}};
  out.pictures.reserve(hover.shots.size());
  for (const Shot& shot : hover.shots) {
    out.pictures.push_back(
        LevelFrustum(field, hover.position, shot.yaw_rad, shot.pitch_rad, reach_m));
  }
  return out;
}

}  // namespace stucco::plan
