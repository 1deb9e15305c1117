// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"

namespace stucco::plan {

// Orders the photos of one hover so that the camera turns as little as possible from the first to
// the last: the best order up to nine photos, a good one beyond. Deterministic; which end comes
// first is not meant.
void OrderShots(std::vector<Shot>& shots);

}  // namespace stucco::plan
