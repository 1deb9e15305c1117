// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "calib/adjust/covariance.h"
#include "calib/scene/scene.h"

namespace stucco {

// Why a pose is not to be trusted alone, for people: few points hold it, or it is much less sure
// than `usual`, the standard deviation of the middle one of its part; empty where neither is so.
// `position_sigma` below 0: not known.
std::string WhyWeak(double position_sigma, int observations, double usual);

// Registered photos of which that is so among all of the scene, ascending. `sigmas` are by photo.
std::vector<int> WeakPoses(const Scene& scene, const std::vector<PoseSigma>& sigmas);

}  // namespace stucco
