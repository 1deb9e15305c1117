// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/camera/preset.h"
#include "site/site.h"

namespace stucco::plan {

// Gives every photo a target on every facade that it sees: the box around the part. For methods
// that plan no photo for any facade, so that all of them count when a facade is judged.
void TargetAllSeen(const Site& site, const CameraPreset& camera, double d_max_m,
                   std::vector<Hover>& hovers, int threads);

}  // namespace stucco::plan
