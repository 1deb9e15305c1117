// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>

#include "survey/geometry2d.h"

namespace stucco {

// The ring with a corner for each edge that cuts one off: one that nothing holds, between two that
// something does, whose lines meet within `reach` of both its ends. What is seen badly near a
// corner is cut like this; where a corner is really cut, the wall that does it holds the edge.
Ring WithCorners(Ring ring, const std::function<bool(const Segment2d&)>& is_held, double reach);

}  // namespace stucco
