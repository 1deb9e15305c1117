// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>

#include "survey/geometry2d.h"
#include "survey/intervals.h"

namespace stucco::plan {

// The part of s (0 at a, 1 at b) that is nearer than `radius` to t. It is one interval, as the
// points near a segment form a convex set.
std::optional<Interval> PartNear(const Segment2d& s, const Segment2d& t, double radius);

}  // namespace stucco::plan
