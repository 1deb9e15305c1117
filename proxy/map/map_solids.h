// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "proxy/cloud/input.h"
#include "proxy/map/outlines.h"
#include "proxy/options/findings.h"
#include "proxy/options/proxy_options.h"
#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

// The buildings of a map as solids.
struct MapModel {
  std::vector<Building> buildings;    // in the map's order, then what it lacks: C0001, C0002 ...
  std::vector<MapBuilding> outlines;  // of all of them, where the survey shows them
};

// Closes every building of the map that stands (close_building.h), its outline fitted to the walls
// (outline_fit.h). Walls have the facades of the plan that they are made from. Points only say how
// much of a facet was seen. What the map has and the cloud denies (the ground lies open where a
// building should be) is left out and named, as is what was never seen and has no facade in the
// plan. What stands beside all of it is closed on footprints found in the cloud (off_the_map.h):
// as a part of the house that it leans on as a wing (wings.h), else as a building of its own.
// Nothing where the map is not of this place; `findings` then warns why. Requires a plan and an
// "enu" georef in metres.
std::optional<MapModel> BuildFromMap(const PlanarScene& scene, const ProxyInput& input,
                                     const ProxyOptions& options, int threads,
                                     ProxyFindings& findings);

// The same of a survey without a map, on footprints found in the cloud alone: houses that are
// extrusions of these (judge_found.h). Requires a georef in metres.
MapModel BuildWithoutMap(const PlanarScene& scene, const ProxyInput& input,
                         const ProxyOptions& options, int threads, ProxyFindings& findings);

}  // namespace stucco
