// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// Tracks with points, ascending, that give every registered photo about `per_photo` observations
// spread over its picture: of a grid's cells each gets its share as long as it has tracks, those
// that most photos see first, as they tie most together. All tracks with points where that is not
// at least a third fewer.
std::vector<int> ChooseTracks(const Scene& scene, int per_photo);

}  // namespace stucco
