// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "texture/epoch/changes.h"

namespace stucco {

// Takes out of a facet's new picture (label 255) the plants that stand before it now and did not
// then: they are not the facet. Where they are more than half of what new photos show of it they
// hide it, and all is taken out: gaps between leaves and boughs are as little the facet. Returns
// whether that is so. Requires pictures of one size.
bool LeaveOutNewPlants(const FacetPicture& before, FacetPicture& after);

}  // namespace stucco
