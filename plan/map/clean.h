// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/map/raw_map.h"
#include "site/site.h"

namespace stucco::plan {

struct CleanedMap {
  std::vector<Footprint> footprints;  // z above the ground; in the order of the map
  RepairLog repairs;
};

// Footprints out of the features of a map in the frame of the plan: contours closed, turned
// counter-clockwise and free of self-crossings; corners that are on a straight wall within 5 cm
// left out; neighbours within 5 cm of each other made to share corners and walls; duplicates left
// out; overlaps cut off the smaller building; parts of a building put in the place of its outline
// (https://wiki.openstreetmap.org/wiki/Simple_3D_Buildings). Afterwards no two footprints share
// area, except parts of one building above each other, coordinates are whole millimetres, and walls
// of neighbours either are the same or do not meet. A building inside another becomes a part of it
// where it is known to be higher, and is left out otherwise. Every repair is noted.
CleanedMap CleanMap(const std::vector<MapFeature>& features);

}  // namespace stucco::plan
