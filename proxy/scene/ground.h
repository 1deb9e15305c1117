// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/planes/plane.h"

namespace stucco {

// Indices of the planes that are ground, the main one first: within 20 degrees of level, lowest
// around themselves (planes_in_plan.h), and going on in one another from the main one, which is
// large and at the foot of the scene; apart from the rest also yards and terraces near the height
// of the ground next to them. Empty when the cloud shows no ground.
std::vector<int> FindGround(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, const std::vector<Plane>& planes);

// The ground plane that a building stands on: the one with most points around it. Null without any.
const Plane* GroundBelow(const Samples& samples, const Eigen::Vector3d& up,
                         std::span<const Plane> ground, const std::vector<Plane>& planes);

// Ground seen in patches too small for planes of their own (gravel, lawn): the level at the foot of
// the scene at which most samples look up, as a plane through them. Nothing when they cover too
// little.
std::optional<Plane> FitFloor(const Samples& samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up);

}  // namespace stucco
