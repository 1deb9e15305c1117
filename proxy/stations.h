// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <map>
#include <vector>

#include "survey/reconstruction.h"

namespace stucco {

// Where a photo was taken and how the camera was held; directions are unit vectors in the world.
struct Station {
  Eigen::Vector3d center = Eigen::Vector3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::UnitX();      // x of the camera
  Eigen::Vector3d upwards = Eigen::Vector3d::UnitZ();    // -y of the camera
  Eigen::Vector3d backwards = Eigen::Vector3d::UnitY();  // -z of the camera
};

struct Stations {
  std::vector<Station> all;
  std::map<uint32_t, int> index_of_photo;  // PhotoId value -> index into `all`
};

Stations StationsOf(const Reconstruction& reconstruction);

}  // namespace stucco
