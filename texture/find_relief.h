// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <memory>
#include <span>

#include "survey/proxy.h"
#include "texture/candidates.h"
#include "texture/grid.h"
#include "texture/look.h"
#include "texture/relief.h"

namespace stucco {

// What stands out of a facet (up to 1.6 m) or lies back in it (up to 0.5 m), from the photos alone:
// all are brought onto planes parallel to the facet's; at each place that plane counts on which
// photos from different sides show the same (plane sweep, Collins 1996, with normalised
// cross-correlation), smoothly over the facet (semi-global matching). What no pair of photos can
// tell stays on the plane, and so do regions that match hardly better before or behind it than on
// it. `candidates` are the photos, best first. Nothing where all is on the plane. Lengths are
// metres: for surveys that are.
std::shared_ptr<const Relief> FindRelief(const Facet& facet, const TexelGrid& grid,
                                         std::span<const Candidate> candidates,
                                         const ViewLimits& limits, const PaintScene& scene);

// About what FindRelief holds at once, bytes.
uint64_t ReliefBytes(const TexelGrid& grid);

}  // namespace stucco
