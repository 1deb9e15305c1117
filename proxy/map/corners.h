// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "survey/geometry2d.h"

namespace stucco {

using IsHeld = std::function<bool(const Segment2d&)>;

// The ring with a corner for each edge that cuts one off: one that nothing holds, between two that
// something does, whose lines meet within `reach` of both its ends. What is seen badly near a
// corner is cut like this; where a corner is really cut, the wall that does it holds the edge.
Ring WithCorners(Ring ring, const IsHeld& is_held, double reach);

// The ring without steps that no wall makes: edges that nothing holds, all within `depth` of the
// lines of the two held ones around them, give way to these lines, which meet within `reach` of
// all of them or are one. Balconies, and eaves at a corner that was seen badly, step like this.
Ring WithoutSteps(Ring ring, const IsHeld& is_held, double reach, double depth);

}  // namespace stucco
