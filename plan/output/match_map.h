// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/plan.h"

namespace stucco::plan {

// plan/matches.svg: a map of which photos should match which, and how surely. A line joins two
// stops with photos that are partners, coloured by the strongest pair; a dot is a stop, coloured by
// the third-strongest partner of its worst photo. Plans that tell no partners (older than these)
// give stops without lines.
std::string MatchSvg(const Plan& plan);

}  // namespace stucco::plan
