// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/crs.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <Eigen/Geometry>
#include <cmath>
#include <limits>
#include <memory>

#include "plan/map/internal/ogr.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* transformation) const {
    OGRCoordinateTransformation::DestroyCT(transformation);
  }
};

// Heights are dropped: footprints have none of their own.
bool Read(const std::string& crs, OGRSpatialReference& reference) {
  const internal::QuietGdal quiet;
  if (reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) return false;
  reference.DemoteTo2D(nullptr);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return true;
}

bool IsGeographic(const std::string& crs) {
  OGRSpatialReference reference;
  return Read(crs, reference) && reference.IsGeographic();
}

// On the earth at all, and not a drawing with axes of its own.
bool IsOnEarth(const std::string& crs) {
  OGRSpatialReference reference;
  return Read(crs, reference) && (reference.IsGeographic() || reference.IsProjected());
}

// Transforms x and y in place; NaN where that fails.
void Transform(const std::string& from, const std::string& to, const std::string& file,
               std::vector<double>& x, std::vector<double>& y) {
  OGRSpatialReference source;
  OGRSpatialReference target;
  const internal::QuietGdal quiet;
  const bool known = Read(from, source) && Read(to, target);
  const std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation> transformation(
      known ? OGRCreateCoordinateTransformation(&source, &target) : nullptr);
  if (!transformation) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: its coordinate system cannot be used: {}", file,
                            internal::QuietGdal::Message()),
                "name another with --map-crs, or save the map in WGS 84 (EPSG:4326)");
  }
  std::vector<int> succeeded(x.size(), FALSE);
  transformation->Transform(static_cast<int>(x.size()), x.data(), y.data(), nullptr,
                            succeeded.data());
  for (size_t i = 0; i < x.size(); ++i) {
    if (succeeded[i] == TRUE && std::isfinite(x[i]) && std::isfinite(y[i])) continue;
    x[i] = kNaN;
    y[i] = kNaN;
  }
}

constexpr char kWgs84[] = "OGC:CRS84";

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
  if (!map_crs.empty() && !IsOnEarth(map_crs)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--map-crs {}: is no coordinate system on the earth", map_crs),
                "give an EPSG code, as EPSG:25832, or a PROJ text");
  }
  const Eigen::AlignedBox2d bounds = BoundsOf(map);
  const bool degrees = LooksLikeDegrees(bounds);
  const bool own_fits =
      !map.crs.empty() && IsOnEarth(map.crs) && (degrees || !IsGeographic(map.crs));
  if (own_fits) return map.crs;
  if (map_crs.empty()) FailWithoutCrs(map, degrees);
  if (degrees || !IsGeographic(map_crs)) return map_crs;
  throw Error(ErrorKind::kUsage,
              fmt::format("--map-crs {}: has degrees, but {} has coordinates up to {:.0f}, {:.0f}",
                          map_crs, map.path.string(), bounds.max().x(), bounds.max().y()),
              "name the system in metres that the map is in, as EPSG:25832");
}

std::vector<Geodetic> GeodeticFromCrs(const std::string& crs,
                                      std::span<const Eigen::Vector2d> points,
                                      const std::string& file) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Eigen::Vector2d& point : points) {
    x.push_back(point.x());
    y.push_back(point.y());
  }
  Transform(crs, kWgs84, file, x, y);
  std::vector<Geodetic> result;
  for (size_t i = 0; i < x.size(); ++i) result.push_back({y[i], x[i]});
  return result;
}

std::vector<Eigen::Vector2d> CrsFromGeodetic(const std::string& crs,
                                             std::span<const Geodetic> points,
                                             const std::string& file) {
  std::vector<double> x;
  std::vector<double> y;
  for (const Geodetic& point : points) {
    x.push_back(point.longitude_deg);
    y.push_back(point.latitude_deg);
  }
  Transform(kWgs84, crs, file, x, y);
  std::vector<Eigen::Vector2d> result;
  for (size_t i = 0; i < x.size(); ++i) result.emplace_back(x[i], y[i]);
  return result;
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
