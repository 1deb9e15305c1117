// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// Registered photos by what ties them: two groups that see `least_points` points or more in common
// are one. Largest first, photos ascending.
std::vector<std::vector<int>> TiedGroups(const Scene& scene, int least_points);

// The scene as these photos alone see it, with the same indices of photos and cameras: others have
// no keypoints and no pose, tracks are those between them. Points that fewer than two of them see
// are gone.
Scene SceneOf(const Scene& scene, const std::vector<int>& photos);

// Takes the poses of these photos, and what they observed; points that fewer than two others see
// are gone.
void TakePoses(const std::vector<int>& photos, Scene& scene);

}  // namespace stucco
