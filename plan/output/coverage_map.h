// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/match/photo_coverage.h"
#include "survey/plan.h"

namespace stucco::plan {

// plan/coverage.svg: two maps side by side, of the finest pixel on walls, roofs and ground, and of
// how many photos show them. A wall is a line; it has the colour of the worst of its heights.
std::string CoverageSvg(const Plan& plan, const PhotoCoverage& coverage);

}  // namespace stucco::plan
