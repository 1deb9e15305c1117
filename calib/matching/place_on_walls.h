// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "calib/matching/shown_walls.h"

namespace stucco {

// Photos of which only the record tells where they were, placed before a wall that repeats itself
// by what all photos with sure poses show of it together: one of them alone may show too little
// that differs from bay to bay, or from so far off that the next bay looks as like. Photos that are
// placed so tell the next ones, along the wall, until there is nothing more to tell. Angles stay
// those of the records. Returns the poses with those that were placed.
std::vector<std::optional<KnownPose>> PlaceOnWalls(const AgainInput& input);

}  // namespace stucco
