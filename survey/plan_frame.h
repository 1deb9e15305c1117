// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "survey/georef.h"
#include "survey/plan.h"

namespace stucco {

// WGS 84.
struct Geodetic {
  double latitude_deg = 0;
  double longitude_deg = 0;
};

// The frame of a plan is the transverse Mercator map of WGS 84 with scale 1 on the origin's
// meridian: what PROJ calls by the text that FrameCrs gives. Krueger's series to the fourth order
// in n (Karney, "Transverse Mercator with an accuracy of a few nanometers", 2011): exact to a
// micrometre within 1000 km.
Geodetic GeodeticFromPlan(const PlanOrigin& origin, const Eigen::Vector2d& position);
Eigen::Vector2d PlanFromGeodetic(const PlanOrigin& origin, const Geodetic& geodetic);

// Where a point of the plan lies east and north in the world frame of an "enu" survey. Heights stay
// out of it: plans count them from the terrain, surveys as their photos state them, and over the
// kilometre of a site a height of 100 m moves nothing by more than 2 cm. Requires georef.frame
// "enu".
Eigen::Vector2d EnuFromPlan(const PlanOrigin& origin, const Georef& georef,
                            const Eigen::Vector2d& position);

// "+proj=tmerc +lat_0=... "; the origin's height is not part of it.
std::string FrameCrs(const PlanOrigin& origin);

// Origin of a frame around a place, on a lattice of 1e-5 degrees (about a metre), so that a corner
// of the map that moves by a few centimetres moves nothing else.
PlanOrigin OriginNear(const Geodetic& place);

}  // namespace stucco
