// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/geometry2d.h"

namespace stucco {

enum class Heading { kAlike, kOpposite };

// Metres of a line that lie beside another that heads about (to 14 degrees) the same or the
// opposite way, where their middle is within `reach` of it.
double SharedLength(const Segment2d& line, const Segment2d& other, double reach, Heading heading);

}  // namespace stucco
