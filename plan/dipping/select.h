// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/dipping/wall_view.h"

namespace stucco::plan {

// Paper, section 4.2: of points that all could capture something, few that together still capture
// as much of every facade. Points go in order of the sum of their view scores (eq. 3), lowest
// first, then single views of those that stay, as long as nothing is lost.
std::vector<DippingPoint> SelectPoints(const DippingSetting& setting,
                                       std::vector<DippingPoint> points);

}  // namespace stucco::plan
