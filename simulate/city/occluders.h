// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/city/city_model.h"
#include "simulate/city/town.h"

namespace stucco::simulate {

// Trees and parked cars, as elements under kOccluderPrefix.
void AddOccluders(const Town& town, CityModel& model);

}  // namespace stucco::simulate
