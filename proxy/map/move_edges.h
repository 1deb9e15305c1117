// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>

#include "survey/geometry2d.h"

namespace stucco {

// Whether the rings are simple polygons, one inside the other, none touching.
bool IsSimple(const Polygon& polygon);

// How far outwards an edge moves at its ends, metres: where they differ it turns.
struct EdgeMove {
  double at_start = 0, at_end = 0;
};

// The polygon with each edge moved, ring by ring from the first corner on; corners go where the
// moved edges meet. Nothing where that crosses itself, or is more than twice or less than half as
// large. Requires a move for each edge.
std::optional<Polygon> WithEdgesMoved(const Polygon& polygon, std::span<const EdgeMove> moves);

}  // namespace stucco
