// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/control/ground_control.h"
#include "survey/georef.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {

// A frame somewhere in Europe.
Georef MadeFrame();

// Control points named P0, P1 ... at positions in the frame, marked wherever a photo of the scene
// shows them, with noise.
GroundControl MakeControl(const Scene& truth, const Georef& frame,
                          const std::vector<Eigen::Vector3d>& positions, double mark_noise_px);

// Corners on the walls and the ground of a made scene, spread in all directions.
std::vector<Eigen::Vector3d> MadeCorners();

// Moves what the file says of a point.
void MovePoint(const Georef& frame, const Eigen::Vector3d& by_m, MarkedPoint& point);

}  // namespace stucco::test
