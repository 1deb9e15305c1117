// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>

#include "texture/light/colour.h"
#include "texture/light/solve_light.h"

namespace stucco {

// The photos' light on one facet. Their gains make them agree where light stays as it is; while the
// sun moves, and in the shade of clouds, it does not, and each facet has its own. So that patches
// of photos of different hours do not differ on it, they are brought to what the photos of its
// middle hour show of it, by least squares on what its ratios leave after the photos' gains. Photos
// without a ratio, and those of one hour, keep their gains.
PhotosLight LightOnFacet(const PhotosLight& light, std::span<const ColourRatio> of_facet);

}  // namespace stucco
