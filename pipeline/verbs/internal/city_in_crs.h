// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "survey/georef.h"

namespace stucco {

// What the corners of proxy.city.json are in: the world of the survey, turned so that `up` is z.
struct CityFrame {
  Georef georef;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();  // unit, in the world of the survey
};

// The text of proxy.city.json with its corners east, north and high in `crs` ("EPSG:2056"), in its
// units, and metadata.referenceSystem set. Heights are those that the survey's positions have,
// whatever the system counts them from. Written to a tenth of what the survey's own file has, so
// that corners stay apart that are so there, and solids stay solids. Throws Error: kUsage where
// `crs` is no EPSG code or has degrees, kBadInput where the survey does not lie on the earth
// (georef.frame not "enu") or the system has no place for it.
std::string CityInCrs(const std::string& city_json, const CityFrame& frame, const std::string& crs);

}  // namespace stucco
