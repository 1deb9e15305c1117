// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "simulate/city/house_mesh.h"
#include "simulate/city/town.h"
#include "site/site.h"
#include "survey/georef.h"

namespace stucco::simulate {

// map.geojson: outlines in WGS 84 with id, height above the lowest ground under the building (the
// top of roof and parapet: what a drone must clear, short of chimneys) and storeys.
void WriteMap(const Town& town, const Georef& georef, const std::filesystem::path& path);

// terrain.tif: heights above the ellipsoid in WGS 84 degrees, about a metre apart.
void WriteTerrain(const Town& town, const Georef& georef, const std::filesystem::path& path);

// Of a wall that shows above the roof of a lower neighbour only.
bool StandsAboveNeighbour(const Site& site, const Facade& facade);

// Reads the map as the planner does and finds the facade of every wall that stands free. Throws
// Error (kStageFailed) where a free wall has none, or a facade neither a wall nor a lower
// neighbour: the truth would name the wrong walls.
FacadeIds FindFacades(const Town& town, const Georef& georef, const std::filesystem::path& map,
                      const std::optional<std::filesystem::path>& terrain);

}  // namespace stucco::simulate
