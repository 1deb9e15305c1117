// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/coordinate_system.h"

#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cassert>
#include <cmath>
#include <limits>
#include <memory>

#include "survey/error.h"
#include "survey/quiet_gdal.h"

namespace stucco {
namespace {

constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* transformation) const {
    OGRCoordinateTransformation::DestroyCT(transformation);
  }
};

bool Read(const std::string& crs, OGRSpatialReference& reference) {
  const QuietGdal quiet;
  return reference.SetFromUserInput(crs.c_str(),
                                    OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) ==
         OGRERR_NONE;
}

// Heights are dropped: what a geoid model would add depends on the grids that a machine has.
bool ReadHorizontal(const std::string& crs, OGRSpatialReference& reference) {
  if (!Read(crs, reference)) return false;
  reference.DemoteTo2D(nullptr);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return true;
}

// Transforms x and y in place; NaN where that fails.
void Transform(const std::string& from, const std::string& to, const std::string& file,
               std::vector<double>& x, std::vector<double>& y) {
  OGRSpatialReference source;
  OGRSpatialReference target;
  const QuietGdal quiet;
  const bool known = ReadHorizontal(from, source) && ReadHorizontal(to, target);
  const std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation> transformation(
      known ? OGRCreateCoordinateTransformation(&source, &target) : nullptr);
  if (!transformation) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: its coordinate system cannot be used: {}", file, QuietGdal::Message()),
        "export it in another, such as WGS 84 (EPSG:4326) or UTM");
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

}  // namespace

bool IsCrsOnEarth(const std::string& crs) {
  OGRSpatialReference reference;
  return Read(crs, reference) && (reference.IsGeographic() || reference.IsProjected());
}

bool IsCrsGeographic(const std::string& crs) {
  OGRSpatialReference reference;
  return Read(crs, reference) && reference.IsGeographic();
}

CrsUnits UnitsOfCrs(const std::string& crs) {
  assert(IsCrsOnEarth(crs));
  OGRSpatialReference reference;
  Read(crs, reference);
  CrsUnits units;
  if (reference.IsProjected()) units.horizontal_m = reference.GetLinearUnits();
  if (reference.GetAxesCount() < 3) return units;
  units.vertical_m =
      reference.IsCompound() ? reference.GetTargetLinearUnits("VERT_CS") : units.horizontal_m;
  return units;
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

}  // namespace stucco
