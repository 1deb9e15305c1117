// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "proxy/plane.h"
#include "proxy/samples.h"
#include "proxy/scale.h"

namespace stucco {

// Indices of the planes that are ground, the main one first: large, near horizontal, looking up and
// at the foot of the scene (height scored against the lowest 2 % of all points on planes), and
// terraces and slopes near its height. Empty when the cloud shows no ground.
std::vector<int> FindGround(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, const std::vector<Plane>& planes);

// Ground seen in patches too small for planes of their own (gravel, lawn): the level at the foot of
// the scene at which most samples look up, as a plane through them. Nothing when they cover too
// little.
std::optional<Plane> FitFloor(const Samples& samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up);

}  // namespace stucco
