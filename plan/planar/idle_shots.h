// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "site/sightings.h"

namespace stucco::plan {

// Takes out the photos of which less than a tenth shows what the samples of the view stand for,
// each for a patch of `patch_m2`, and hovers without any left. Returns how many photos are gone.
size_t DropIdleShots(const SurfaceView& view, double patch_m2, int threads,
                     std::vector<Hover>& hovers);

}  // namespace stucco::plan
