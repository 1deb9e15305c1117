// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "proxy/facets/plane_view.h"
#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

struct SolidOptions {
  int max_planes = 60;
  double least_support = 0.65;  // share of walls and roofs with points
};

struct Solid {
  std::vector<Facet> facets;  // empty: no solid
  std::string why_not;        // for the log
  double support = 0;         // share of walls and roofs with points
  double agreement = 0;       // share of the planes' points that the surface runs through
};

// The watertight solid of a building: its planes cut the building's box to cells, cells are
// labelled inside or outside, the boundary is merged to facets. Refused when points cover too
// little of it, when it misses too many points, or when it is not a sound boundary
// (closed_check.h). `ground` may be null: the lowest points close the bottom then.
Solid CloseBuilding(const PlanarScene& scene, const std::vector<const PlaneView*>& views,
                    const Plane* ground, const SolidOptions& options);

}  // namespace stucco
