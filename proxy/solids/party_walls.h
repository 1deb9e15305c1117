// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/proxy.h"

namespace stucco {

// Sets `party` of all walls: the share of its area that walls of other buildings stand against,
// face to face with a gap that nobody sees into (0.3 m). `buildings` are in metres.
void MeasureParty(std::vector<Building>& buildings);

}  // namespace stucco
