// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "calib/scene/scene.h"
#include "tests/calib/made_scene.h"

namespace stucco::test {

// A survey in two halves that share nothing but the camera, true poses and points: photos of
// `second` follow those of `first`, `shift` away from where it was made.
Scene Joined(const Scene& first, const Scene& second, const Eigen::Vector3d& shift);

// The same places photographed in two halves of which the second was not matched with the first:
// photos from `begin` on share no track with those before.
Scene Unmatched(const Scene& scene, int begin);

}  // namespace stucco::test
