// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>
#include <vector>

#include "simulate/city/city_model.h"
#include "simulate/city/solid.h"
#include "simulate/city/town.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::simulate {

Solid SolidOf(const House& house);

// By edge of each house: the planner's facade, empty for party walls.
using FacadeIds = std::vector<std::vector<std::string>>;

// The building as exact polygons: walls under the ids of their facades, party walls as W.., roofs
// R0, R1 ... by falling area, the floor as G0. Party walls and floors have seen 0, the others 1.
Building TruthOf(const House& house, const Solid& solid, const std::vector<std::string>& facades);

// Adds a house to the model, and the pictures of its walls and roofs to the truth.
void AddHouse(const House& house, const std::vector<std::string>& facades, double metres_per_texel,
              CityModel& model, TextureSet& truth);

}  // namespace stucco::simulate
