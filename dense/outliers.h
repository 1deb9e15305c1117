// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/point_cloud.h"

namespace stucco {

// Statistical outlier removal (Rusu et al. 2008): drops points whose mean distance to their 10
// nearest neighbours exceeds the cloud's mean by `sigmas` standard deviations. Distances count in
// units of `spacing`, the distance between neighbouring pixels on the surface at each point, so
// that what was only seen from afar is not held against what was seen from near. Returns how many.
size_t RemoveOutliers(double sigmas, const std::vector<float>& spacing, int threads,
                      PointCloud& cloud);

}  // namespace stucco
