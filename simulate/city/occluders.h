// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "simulate/city/city_model.h"
#include "simulate/city/town.h"

namespace stucco::simulate {

// The element that a car is in the model.
std::string ElementOf(const Car& car);

// Trees and parked cars, as elements under kOccluderPrefix.
void AddOccluders(const Town& town, CityModel& model);

}  // namespace stucco::simulate
