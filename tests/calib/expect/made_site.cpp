// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/expect/made_site.h"

#include "survey/attitude.h"

namespace stucco::test {

Camera SiteCamera() {
  return {CameraId{1}, CameraModel::kPinhole, 1000, 750, {700, 700, 500, 375}};
}

Pose SitePose(const Eigen::Vector3d& position, double yaw_deg, double pitch_deg) {
  const Eigen::Quaterniond rotation = CamFromEnu({yaw_deg, pitch_deg, 0});
  return {rotation, -(rotation * position)};
}

}  // namespace stucco::test
