// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string_view>
#include <vector>

#include "proxy/cloud/input.h"
#include "proxy/map/outline_fit.h"
#include "proxy/map/outlines.h"
#include "proxy/options/findings.h"
#include "proxy/options/proxy_options.h"
#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

// How much of a building's solid the cloud holds.
enum class SolidDetail {
  kFull,     // walls fitted, every roof plane that was found
  kCoarse,   // only the largest roof planes: all of them gave no sound solid
  kFlatTop,  // LoD1.2: a level top at the height that points show
  kFromMap,  // the plan extruded, where no points say better
};
std::string_view Name(SolidDetail detail);

// The buildings of a map as solids.
struct MapModel {
  std::vector<Building> buildings;    // in the map's order, then what it lacks: C0001, C0002 ...
  std::vector<MapBuilding> outlines;  // of all of them, where the survey shows them
};

// Closes every building of the map that stands: its outline fitted to the walls (outline_fit.h),
// its footprint cut and labelled by roof planes (roof_cells.h) and extruded from the ground
// (extrude_cells.h); coarser where that is no sound solid as written. Walls have the facades of the
// plan that they are made from. Points only say how much of a facet was seen. What the map has and
// the cloud denies (the ground lies open where a building should be) is left out and named, as is
// what was never seen and has no facade in the plan. What stands beside all of it is closed on
// footprints found in the cloud (off_the_map.h). Nothing where the map is not of this place;
// `findings` then warns why. Requires a plan and an "enu" georef in
// metres.
std::optional<MapModel> BuildFromMap(const PlanarScene& scene, const ProxyInput& input,
                                     const ProxyOptions& options, int threads,
                                     ProxyFindings& findings);

}  // namespace stucco
