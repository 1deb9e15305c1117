// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/map/raw_map.h"

namespace stucco::plan::internal {

// Too small or too thin to be a building: under 1 m2, or on average under 20 cm wide.
bool IsSliver(const Polygon& polygon);

// The polygons of a feature, valid, oriented, without slivers, tiny holes and corners on straight
// walls. Notes what it mends under the feature's building.
std::vector<Polygon> CleanOutlines(const MapFeature& feature, RepairLog& repairs);

// Valid polygons in place of one that snapping may have spoilt; slivers left out.
std::vector<Polygon> ValidParts(const Polygon& polygon);

}  // namespace stucco::plan::internal
