// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/facets/plane_view.h"
#include "survey/proxy.h"

namespace stucco {

// The open facets of a plane: its outline, with figures and class, without ids.
std::vector<Facet> OutlineFacets(const Samples& samples, const PlaneView& view,
                                 const std::vector<CutLine>& creases, const Tolerances& tolerances,
                                 bool ground);

// A facet out of a polygon in the plane of `view`, with area, rms, support and seen share measured.
Facet MakeFacet(const Samples& samples, const PlaneView& view, const Polygon& polygon);

// Ids by class and falling area: C0001/W00, C0001/W01 ... R0 ... O0 (overhangs). The ground's are
// G0, G1 ...
void AssignIds(Building& building);

}  // namespace stucco
