// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "site/site.h"

namespace stucco {

// Two walls nearer than this are one: neighbours rarely agree better on where their common wall is.
inline constexpr double kSnap_m = 0.05;

// The ring in its own direction, from the corner that lies farthest to the south-west: the same
// facade numbers come out wherever a map starts its rings.
Ring FromSouthWest(Ring ring);

// The walls of the footprints that stand free, from 10 cm length and half a metre height on. Where
// two buildings or parts of one share an edge or a piece of it, that is a party wall and no facade
// up to the lower top; the higher one's wall above it is a facade, from a metre on, where both tops
// are known. Footprints beside the area (`in_area` false) get none; obstacles make no party walls.
//
// Ids count the walls of a building from corner to corner, party walls included, over its
// footprints and rings, so that a neighbour that is built or torn down renumbers nothing:
// B0012/F03. Of a wall that falls into several facades, as where a neighbour begins, the later ones
// get a letter: B0012/F03b. Those above the roofs of other buildings come last, whatever their
// place along the wall, so that the height of a neighbour renumbers nothing either.
std::vector<Facade> MakeFacades(const std::vector<Footprint>& footprints);

}  // namespace stucco
