// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco {

// World file (six lines) of a facet's picture. On level facets of a survey whose z is up it maps
// pixels to world x and y (a map); elsewhere to the facet's plane: x along the facet from its left
// edge, y upwards along it, counted so that on a vertical facet it is the world height.
std::string WorldFile(const TexturedFacet& texture, const Facet& facet, const Proxy& proxy);

// What a measuring program needs to know: size of a pixel, the plane, the axes and the corner in
// world coordinates, the frame these are in, and how much was seen.
std::string OrthophotoJson(const TexturedFacet& texture, const Facet& facet, const Proxy& proxy,
                           const Georef& georef);

}  // namespace stucco
