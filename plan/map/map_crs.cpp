// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/map_crs.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <vector>

#include "survey/coordinate_system.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

Eigen::AlignedBox2d BoundsOf(const RawMap& map) {
  Eigen::AlignedBox2d bounds;
  for (const MapFeature& feature : map.features) {
    for (const Polygon& polygon : feature.polygons) {
      for (const Eigen::Vector2d& corner : polygon.rings.front()) {
        if (corner.allFinite()) bounds.extend(corner);
      }
    }
  }
  return bounds;
}

bool LooksLikeDegrees(const Eigen::AlignedBox2d& bounds) {
  return bounds.min().x() >= -180 && bounds.max().x() <= 360 && bounds.min().y() >= -90 &&
         bounds.max().y() <= 90;
}

[[noreturn]] void FailWithoutCrs(const RawMap& map, bool degrees) {
  if (degrees) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: names no coordinate system; its coordinates look like degrees",
                            map.path.string()),
                "say which it is: --map-crs EPSG:4326 for longitude and latitude of WGS 84");
  }
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: names no coordinate system; its coordinates look like metres",
                  map.path.string()),
      "say which it is, as --map-crs EPSG:25832 for UTM zone 32 (a Shapefile needs its .prj "
      "file beside it)");
}

}  // namespace

std::string CrsOfMap(const RawMap& map, const std::string& map_crs) {
  if (!map_crs.empty() && !IsCrsOnEarth(map_crs)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--map-crs {}: is no coordinate system on the earth", map_crs),
                "give an EPSG code, as EPSG:25832, or a PROJ text");
  }
  const Eigen::AlignedBox2d bounds = BoundsOf(map);
  const bool degrees = LooksLikeDegrees(bounds);
  const bool own_fits =
      !map.crs.empty() && IsCrsOnEarth(map.crs) && (degrees || !IsCrsGeographic(map.crs));
  if (own_fits) return map.crs;
  if (map_crs.empty()) FailWithoutCrs(map, degrees);
  if (degrees || !IsCrsGeographic(map_crs)) return map_crs;
  throw Error(ErrorKind::kUsage,
              fmt::format("--map-crs {}: has degrees, but {} has coordinates up to {:.0f}, {:.0f}",
                          map_crs, map.path.string(), bounds.max().x(), bounds.max().y()),
              "name the system in metres that the map is in, as EPSG:25832");
}

void MoveToPlan(RawMap& map, const std::string& crs, const PlanOrigin& origin) {
  std::vector<Eigen::Vector2d> points;
  for (const MapFeature& feature : map.features) {
    for (const Polygon& polygon : feature.polygons) {
      for (const Ring& ring : polygon.rings) points.insert(points.end(), ring.begin(), ring.end());
    }
  }
  const std::vector<Geodetic> places = GeodeticFromCrs(crs, points, map.path.string());
  auto place = places.begin();
  for (MapFeature& feature : map.features) {
    for (Polygon& polygon : feature.polygons) {
      for (Ring& ring : polygon.rings) {
        for (Eigen::Vector2d& corner : ring) corner = PlanFromGeodetic(origin, *place++);
      }
    }
  }
}

Geodetic MiddleOf(const RawMap& map, const std::string& crs) {
  const Eigen::AlignedBox2d bounds = BoundsOf(map);
  const std::vector<Eigen::Vector2d> middle = {bounds.center()};
  const Geodetic place = GeodeticFromCrs(crs, middle, map.path.string()).front();
  if (std::isfinite(place.latitude_deg)) return place;
  throw Error(ErrorKind::kBadInput,
              fmt::format("{}: its coordinates ({:.0f}, {:.0f}) have no place in their coordinate "
                          "system",
                          map.path.string(), bounds.center().x(), bounds.center().y()),
              "check the coordinate system of the map (x east, y north)");
}

}  // namespace stucco::plan
