// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "simulate/flight/options.h"
#include "simulate/render/light.h"

namespace stucco::simulate {

// The lowest sun that is flown in: below, shadows cover everything and the light is gone in
// minutes.
inline constexpr double kLowestSun_deg = 8;

double SunElevation_deg(double latitude_deg, int day_of_year, double solar_hour);

// Sun and sky at a time. The sun is weaker and redder the more air is before it (Kasten and Young,
// "Revised optical air mass tables", 1989; optical depths of clear air); an overcast sky has no sun
// and three times the light of a blue one. At 45 degrees it is what Light has by default.
Light DaylightAt(const FlightOptions& options, double latitude_deg, int day_of_year,
                 double solar_hour);

// What a camera's automatic white balance makes of this light: most of the way to neutral.
Eigen::Vector3d NeutralGains(const Light& light);

}  // namespace stucco::simulate
