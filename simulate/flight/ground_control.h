// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/flight/flight_folder.h"
#include "simulate/flight/placing.h"
#include "survey/ground_control.h"

namespace stucco::simulate {

inline constexpr char kTrueControlFile[] = "truth/gcp_list.txt";

// What a surveyor and a person at a screen make of a flight's scene: about `count` points on
// surfaces, far from each other, that three of the survey's photos or more show, marked in each
// with half a pixel of noise; every fourth is a check point. Coordinates are exact, longitude and
// latitude with heights above the ellipsoid (EPSG:4326). Fewer where photos show fewer.
GroundControlList SurveyPoints(const Flight& flight, const CastRay& cast, int count);

}  // namespace stucco::simulate
