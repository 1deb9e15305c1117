// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/city/city_model.h"
#include "simulate/city/solid.h"
#include "simulate/city/town.h"

namespace stucco::simulate {

// The picture of a roof's face: how it lies, and the face as it is drawn, overhang included.
struct RoofSheet {
  Sheet sheet;  // element and material are left to the caller
  Loop drawn;
};

// The picture of a face of `solid`, a house's, and the face drawn as far as the eaves go.
RoofSheet LayRoofSheet(const House& house, const Solid& solid, const Solid::Face& face);

// Undersides and edges of a pitched roof, or the parapet around a flat one.
void AddRoofEdges(const House& house, const Solid& solid, const Trim& trim, CityModel& model);

// Chimneys, or what stands on a flat roof.
void AddRoofThings(const House& house, const Solid& solid, const Trim& trim, CityModel& model);

}  // namespace stucco::simulate
