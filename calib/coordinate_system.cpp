// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/coordinate_system.h"

#include <cpl_error.h>
#include <fmt/format.h>
#include <ogr_spatialref.h>

#include <cmath>
#include <memory>
#include <sstream>

#include "survey/error.h"

namespace stucco {
namespace {

// While it lives, GDAL and PROJ keep what they have to say to themselves.
class QuietCoordinates {
 public:
  QuietCoordinates() {
    CPLPushErrorHandler(CPLQuietErrorHandler);
    CPLErrorReset();
  }
  ~QuietCoordinates() { CPLPopErrorHandler(); }
  QuietCoordinates(const QuietCoordinates&) = delete;
  QuietCoordinates& operator=(const QuietCoordinates&) = delete;
};

struct DestroyTransformation {
  void operator()(OGRCoordinateTransformation* transformation) const {
    OGRCoordinateTransformation::DestroyCT(transformation);
  }
};

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

// Metres in a unit of the vertical axis; nothing where the system has none.
std::optional<double> VerticalUnit(const OGRSpatialReference& reference) {
  if (reference.GetAxesCount() < 3) return std::nullopt;
  if (reference.IsCompound()) return reference.GetTargetLinearUnits("VERT_CS");
  return reference.IsGeographic() ? 1.0 : reference.GetLinearUnits();
}

constexpr double kUnitTolerance = 1e-9;

}  // namespace

PlacesOnEarth PlacesFromSystem(const std::string& crs, std::span<const Eigen::Vector3d> points,
                               const std::string& file) {
  const QuietCoordinates quiet;
  OGRSpatialReference source;
  OGRSpatialReference wgs84;
  const bool known =
      source.SetFromUserInput(WithoutUtmName(crs).c_str(),
                              OGRSpatialReference::SET_FROM_USER_INPUT_LIMITATIONS_get()) ==
          OGRERR_NONE &&
      (source.IsGeographic() || source.IsProjected());
  wgs84.SetWellKnownGeogCS("CRS84");
  PlacesOnEarth result;
  double unit_m = 1;
  if (known) {
    const auto vertical = VerticalUnit(source);
    unit_m = vertical.value_or(1);
    const double horizontal = source.IsProjected() ? source.GetLinearUnits() : 1;
    if (!vertical && std::abs(horizontal - 1) > kUnitTolerance) {
      result.doubt = fmt::format(
          "{}: {} counts in another unit than metres and says nothing of heights, which are taken "
          "as metres; for others name a system with heights, such as EPSG:2263+6360",
          file, crs);
    }
    source.DemoteTo2D(nullptr);
    source.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
    wgs84.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  }
  const std::unique_ptr<OGRCoordinateTransformation, DestroyTransformation> transformation(
      known ? OGRCreateCoordinateTransformation(&source, &wgs84) : nullptr);
  if (!transformation) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: \"{}\" in its first line is no coordinate system on the earth that "
                    "PROJ knows",
                    file, crs),
        "write an EPSG code (EPSG:25832), a PROJ text, or WGS84 UTM 32N");
  }
  for (const Eigen::Vector3d& point : points) {
    double x = point.x();
    double y = point.y();
    const bool done = transformation->Transform(1, &x, &y) == TRUE;
    auto& place = result.places.emplace_back();
    if (done && std::isfinite(x) && std::abs(y) <= 90) place = {y, x, point.z() * unit_m};
  }
  return result;
}

}  // namespace stucco
