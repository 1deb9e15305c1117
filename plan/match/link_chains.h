// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "plan/match/linked_photos.h"
#include "plan/space/obstacles.h"

namespace stucco::plan {

// Rows of link photos along the corridors between buildings far apart (plan/match/corridors.h),
// where nothing else ties the photos at their ends to each other, or one stop alone: straight down
// from the height of flight, each showing three fifths of what the next one does and a fifth of
// what the one after it does, so that any may be lost. Places that are not free are left out.
// Returns how many photos that are.
int AddChains(const Obstacles& obstacles, LinkedPhotos& photos);

}  // namespace stucco::plan
