// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/depth_map.h"

namespace stucco {

// Removes connected pieces (depth steps below `max_step`, relative) of fewer than `min_pixels`.
void RemoveSpeckles(int min_pixels, float max_step, DepthMap& map);

}  // namespace stucco
