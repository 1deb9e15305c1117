// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco {

// A posed photo as painting needs it.
struct TexturePhoto {
  std::string name;  // path relative to the photo folder
  std::string hash;  // of the file's content
  Camera camera;
  Pose cam_from_world;
  double sharpness = 1;  // against the median of the survey's photos; 1: typical or not known
  // Rays up to this squared radius (x/z, y/z) are known to be where the lens model is one-to-one,
  // which is costly to find out for each; see KnowLens. 0: not known.
  double safe_radius_squared = 0;
  std::vector<std::string> facades;  // that the plan means it for; none without a plan
};

// Finds safe_radius_squared: the farthest corner of the picture, where the lens model allows it.
void KnowLens(TexturePhoto& photo);

// Pixel of a world point, or nothing where it is behind the camera, outside the picture or where
// the lens model folds back (a point far outside the field of view can land inside the picture).
std::optional<Eigen::Vector2d> ProjectIntoPhoto(const TexturePhoto& photo,
                                                const Eigen::Vector3d& point_in_world);

}  // namespace stucco
