// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "survey/geometry2d.h"

namespace stucco {

// Draws back corners, by centimetres, at which an outline touches itself or another of its parts in
// one point only, as a contour of a map does that crosses itself, or a courtyard that reaches the
// street: nothing that stands on such an outline is the boundary of a solid. Parts next to each
// other have their edges or corners in common, to the last digits.
void OpenPinches(std::vector<Polygon>& parts);

}  // namespace stucco
