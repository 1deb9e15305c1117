// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/map/fitted_building.h"
#include "proxy/map/outlines.h"
#include "proxy/map/upright_survey.h"
#include "proxy/options/findings.h"
#include "proxy/planes/plane.h"
#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

// The scene's planes with only the points that lie beside all outlines, without those that are left
// too small; what remains of a building is listed in `findings` as not on the map.
std::vector<std::vector<Plane>> OffTheMap(const PlanarScene& scene,
                                          const std::vector<MapBuilding>& outlines,
                                          ProxyFindings& findings);

// Footprints of what stands beside the floors of `closed` buildings: wings that a map lacks, and
// houses that are newer than it. Roofs above the ground, at least 10 m2 of them and nowhere a strip
// as eaves are, within the walls below them (outline.h); crowns of trees are no roofs. Their walls
// have no facades; samples are those of `survey`, which is the scene's, upright.
std::vector<FittedBuilding> FindNewFootprints(const PlanarScene& scene, const UprightSurvey& survey,
                                              std::span<const Building> closed);

}  // namespace stucco
