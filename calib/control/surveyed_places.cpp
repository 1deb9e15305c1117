// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/control/surveyed_places.h"

#include <fmt/format.h>

#include <cmath>
#include <sstream>

#include "survey/coordinate_system.h"
#include "survey/error.h"

namespace stucco {
namespace {

// "WGS84 UTM 32N" -> "EPSG:32632"; other texts as they are.
std::string WithoutUtmName(const std::string& crs) {
  std::istringstream words(crs);
  std::string datum, utm, rest;
  int zone = 0;
  char hemisphere = 0;
  if (!(words >> datum >> utm >> zone >> hemisphere) || (words >> rest)) return crs;
  const bool is_north = hemisphere == 'N' || hemisphere == 'n';
  const bool is_south = hemisphere == 'S' || hemisphere == 's';
  const bool is_utm = datum == "WGS84" && utm == "UTM" && zone >= 1 && zone <= 60;
  if (!is_utm || (!is_north && !is_south)) return crs;
  return fmt::format("EPSG:{}", (is_north ? 32600 : 32700) + zone);
}

constexpr double kUnitTolerance = 1e-9;

}  // namespace

PlacesOnEarth PlacesFromSystem(const std::string& crs, std::span<const Eigen::Vector3d> points,
                               const std::string& file) {
  const std::string system = WithoutUtmName(crs);
  if (!IsCrsOnEarth(system)) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: \"{}\" in its first line is no coordinate system on the earth that "
                    "PROJ knows",
                    file, crs),
        "write an EPSG code (EPSG:25832), a PROJ text, or WGS84 UTM 32N");
  }
  const CrsUnits units = UnitsOfCrs(system);
  PlacesOnEarth result;
  if (!units.vertical_m && std::abs(units.horizontal_m - 1) > kUnitTolerance) {
    result.doubt = fmt::format(
        "{}: {} counts in another unit than metres and says nothing of heights, which are taken "
        "as metres; for others name a system with heights, such as EPSG:2263+6360",
        file, crs);
  }
  std::vector<Eigen::Vector2d> across;
  for (const Eigen::Vector3d& point : points) across.emplace_back(point.head<2>());
  const std::vector<Geodetic> geodetic = GeodeticFromCrs(system, across, file);
  for (size_t i = 0; i < points.size(); ++i) {
    auto& place = result.places.emplace_back();
    if (!(std::abs(geodetic[i].latitude_deg) <= 90)) continue;
    place = {geodetic[i].latitude_deg, geodetic[i].longitude_deg,
             points[i].z() * units.vertical_m.value_or(1)};
  }
  return result;
}

}  // namespace stucco
