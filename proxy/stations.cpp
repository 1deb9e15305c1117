// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/stations.h"

namespace stucco {

Stations StationsOf(const Reconstruction& reconstruction) {
  Stations stations;
  for (const auto& [id, photo] : reconstruction.photos) {
    const Eigen::Matrix3d world_from_cam =
        photo.cam_from_world.rotation.conjugate().toRotationMatrix();
    stations.index_of_photo[id.value] = static_cast<int>(stations.all.size());
    stations.all.push_back({.center = photo.cam_from_world.Center(),
                            .right = world_from_cam.col(0),
                            .upwards = -world_from_cam.col(1),
                            .backwards = -world_from_cam.col(2)});
  }
  return stations;
}

}  // namespace stucco
