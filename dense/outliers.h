// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/point_cloud.h"

namespace stucco {

// Statistical outlier removal (Rusu et al. 2008, PCL): drops points whose mean distance to their 10
// nearest neighbours exceeds the cloud's mean by `sigmas` standard deviations. Returns how many.
size_t RemoveOutliers(double sigmas, PointCloud& cloud);

}  // namespace stucco
