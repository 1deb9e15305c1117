// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "proxy/imported/flat_pieces.h"
#include "survey/proxy.h"

namespace stucco {

// What pieces of a model are: walls, roofs, undersides and ground by the file or by how they face
// and what stands on or below their edges; and buildings, by the file or by the edges that they
// share. Ids are those of the file where they can be ids of facets ("B0012" and "B0012/R0"), else
// "M0001", "M0001/W00". Closed bodies are turned to face outwards, and buildings that are closed
// are `watertight` where their corners lie on all of their planes; of others, facets that `behind`
// says are seen only from their back are turned. The ground is "G0". Requires z up.
std::vector<Building> SortPieces(const SurfaceModel& model, const WeldedModel& welded,
                                 std::vector<FlatPiece> pieces,
                                 const std::function<bool(const Facet&)>& behind);

}  // namespace stucco
