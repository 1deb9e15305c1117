// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/attitude.h"

#include <cmath>
#include <numbers>

namespace stucco {

Eigen::Quaterniond CamFromEnu(const GimbalAngles& angles) {
  constexpr double kRadians = std::numbers::pi / 180;
  const double yaw = angles.yaw_deg * kRadians;
  const double pitch = angles.pitch_deg * kRadians;
  const double roll = angles.roll_deg * kRadians;
  const Eigen::Vector3d forward(std::sin(yaw) * std::cos(pitch), std::cos(yaw) * std::cos(pitch),
                                std::sin(pitch));
  const Eigen::Vector3d level_right(std::cos(yaw), -std::sin(yaw), 0);
  const Eigen::Vector3d level_down = forward.cross(level_right);
  Eigen::Matrix3d cam_from_enu;
  cam_from_enu.row(0) = std::cos(roll) * level_right + std::sin(roll) * level_down;
  cam_from_enu.row(1) = -std::sin(roll) * level_right + std::cos(roll) * level_down;
  cam_from_enu.row(2) = forward;
  return Eigen::Quaterniond(cam_from_enu).normalized();
}

double WrappedDegrees(double angle_deg) {
  const double wrapped = std::remainder(angle_deg, 360.0);
  return wrapped <= -180 ? wrapped + 360 : wrapped;
}

Eigen::Quaterniond AboutUp(double angle_rad) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle_rad, Eigen::Vector3d::UnitZ()));
}

double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  return std::atan2(a.cross(b).norm(), a.dot(b));
}

Eigen::Vector3d RotationVector(const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation);
  const double angle =
      turn.angle() > std::numbers::pi ? turn.angle() - 2 * std::numbers::pi : turn.angle();
  return angle * turn.axis();
}

Eigen::Quaterniond FromRotationVector(const Eigen::Vector3d& vector) {
  const double angle = vector.norm();
  if (angle < 1e-12) return Eigen::Quaterniond::Identity();
  return Eigen::Quaterniond(Eigen::AngleAxisd(angle, vector / angle));
}

}  // namespace stucco
