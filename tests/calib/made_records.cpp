// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_records.h"

#include <Eigen/Geometry>

#include "calib/records/georeference.h"
#include "survey/attitude.h"

namespace stucco::test {
namespace {

Eigen::Quaterniond Turn(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle == 0) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

Eigen::Vector3d Noise(double sigma, Random& random) {
  const double x = random.Gauss(sigma);
  const double y = random.Gauss(sigma);
  return {x, y, random.Gauss(sigma)};
}

}  // namespace

std::vector<PoseRecord> MakeRecords(const Scene& truth, const MadeRecordErrors& errors) {
  Random random(errors.seed);
  std::vector<PoseRecord> records(truth.photos.size());
  for (size_t i = 0; i < records.size(); ++i) {
    const size_t flight = i % errors.yaw_rad.size();
    const Pose& pose = *truth.photos[i].pose;
    records[i].flight = static_cast<int>(flight);
    records[i].position =
        PositionPrior{pose.Center() + errors.shift_m[flight % errors.shift_m.size()] +
                          Noise(errors.position_sigma_m, random),
                      5, 10};
    const Eigen::Quaterniond yaw = Turn({0, 0, -errors.yaw_rad[flight]});
    records[i].gimbal = (Turn(errors.mount_rad).conjugate() *
                         Turn(Noise(errors.attitude_sigma_rad, random)) * pose.rotation * yaw)
                            .normalized();
  }
  return records;
}

void TurnAboutUp(double angle_rad, Scene& scene) {
  Transform({1, AboutUp(angle_rad), Eigen::Vector3d::Zero()}, scene);
}

}  // namespace stucco::test
