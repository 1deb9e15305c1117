// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "survey/captures.h"

namespace stucco {

// Rotation of a camera with these angles: east-north-up directions into the camera frame (x right,
// y down, z forward). Roll is clockwise as seen from behind the camera.
Eigen::Quaterniond CamFromEnu(const GimbalAngles& angles);

// The same angle in (-180, 180].
double WrappedDegrees(double angle_deg);

// Turn about the up axis, counter-clockwise as seen from above.
Eigen::Quaterniond AboutUp(double angle_rad);

// Radians from 0 to pi, well conditioned at both ends. Neither needs to be of length 1.
double AngleBetween(const Eigen::Vector3d& a, const Eigen::Vector3d& b);

// Axis times angle, radians; of the two that give the rotation the shorter.
Eigen::Vector3d RotationVector(const Eigen::Quaterniond& rotation);
Eigen::Quaterniond FromRotationVector(const Eigen::Vector3d& vector);

}  // namespace stucco
