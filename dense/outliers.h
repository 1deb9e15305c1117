// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <vector>

#include "dense/fused_points.h"

namespace stucco {

struct OutlierOptions {
  double sigmas = 3;
  int threads = 1;
  size_t points_of_slab = size_t{1} << 19;  // that are looked at together, about
};

// Statistical outlier removal (Rusu et al. 2008): which points are within `sigmas` standard
// deviations of the cloud's mean of mean distances to the 10 nearest neighbours, or within twice
// that mean: deviations of a regular cloud are so small that its corners lay beyond. Distances
// count in units of the points' spacing, so that what was only seen from afar is not held against
// what was seen from near, and up to a reach of 16 spacings: where a lonely point's neighbours are
// beyond that does not matter, and no point has to be looked for farther off. So the cloud is
// looked at in slabs across its longest axis, each with what is within reach of it; how many there
// are changes no distance. `folder` takes nameless files meanwhile.
std::vector<bool> FindInliers(FusedPointsFile& points, const OutlierOptions& options,
                              const std::filesystem::path& folder);

}  // namespace stucco
