// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/plan.h"

namespace stucco::test {

// A plan with one house of 20 by 10 m and 12 m height, its long wall along y = 0 facing south
// (facade 0), and a second one of the same size 40 m further south. z = 0 is the ground.
Plan TwoHouses();

}  // namespace stucco::test
