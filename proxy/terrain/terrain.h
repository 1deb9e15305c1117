// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

// The ground of the scene as triangles that meet in their edges, where it is curved or broken: they
// follow it within a third of the level of detail and end at the walls of what is closed among
// `buildings`. Facets without ids, in the world. None where the ground is one plane or level in
// steps, which the outlines of its planes show better, or was not seen.
std::vector<Facet> TerrainFacets(const PlanarScene& scene, std::span<const Building> buildings);

}  // namespace stucco
