// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>

#include "survey/proxy.h"
#include "texture/grid/grid.h"
#include "texture/grid/relief.h"
#include "texture/options/texture_options.h"
#include "texture/views/candidates.h"
#include "texture/views/look.h"

namespace stucco {

// What stands out of a facet (up to 1.6 m) or lies back in it (up to 0.5 m), as rectangles parallel
// to it, from the photos alone: all are brought onto planes parallel to the facet's (see
// SweepPart), and the rectangle on one of them where photos agree most better than on the facet's
// own plane, or on that of an earlier rectangle, is put there, again and again. What no pair of
// photos can tell stays on the plane, and so does what rectangles hide from half of the photos.
// Nothing where all is on the plane. Lengths are metres: for surveys that are.
std::shared_ptr<const Relief> FindRelief(const Facet& facet, const TexelGrid& grid,
                                         const ViewLimits& limits, const PaintScene& scene);

// Whether a facet has relief looked for: walls of metric surveys that no grid is given for.
bool LooksForRelief(const Facet& facet, const FacetLook& look, const TextureOptions& options,
                    bool metric);

// About what FindRelief holds at once, bytes.
uint64_t ReliefBytes(const TexelGrid& grid);

}  // namespace stucco
