// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "survey/epoch.h"
#include "survey/image.h"
#include "texture/epoch/changes.h"
#include "texture/grid/grid.h"

namespace stucco {

// What is listed of a facet's changes: those of more than a tenth of a square metre (of the unit of
// the world), the largest eight.
std::vector<ChangedBox> WorthShowing(std::span<const ChangedBox> boxes, double facet_area);

// Where a box is, without names of pictures.
EpochPlace PlaceOf(const ChangedBox& box, const TexelGrid& grid, double facet_area);

// A place and what is around it, then and now.
struct PlacePictures {
  Image before;
  Image after;
};

// With half of its size around it on each side, in the texels of the facet, or fewer where these
// are more than a page can show. Requires a box inside of both pictures.
PlacePictures ShowPlace(const ChangedBox& box, const FacetPicture& before,
                        const FacetPicture& after);

}  // namespace stucco
