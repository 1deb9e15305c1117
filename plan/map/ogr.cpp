// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/internal/ogr.h"

#include <cpl_string.h>
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "survey/error.h"
#include "survey/geometry2d.h"
#include "survey/quiet_gdal.h"

namespace stucco::plan::internal {
namespace {

Ring RingOf(const OGRLinearRing& line) {
  Ring ring;
  const int count = line.getNumPoints();
  ring.reserve(count);
  for (int i = 0; i < count; ++i) ring.emplace_back(line.getX(i), line.getY(i));
  if (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  return ring;
}

void AddPolygons(const OGRGeometry& geometry, std::vector<Polygon>& polygons) {
  if (const auto* polygon = dynamic_cast<const OGRPolygon*>(&geometry)) {
    Polygon& added = polygons.emplace_back();
    for (const OGRLinearRing* ring : *polygon) added.rings.push_back(RingOf(*ring));
    if (added.rings.empty() || added.rings[0].size() < 3) polygons.pop_back();
  } else if (const auto* collection = dynamic_cast<const OGRGeometryCollection*>(&geometry)) {
    for (const OGRGeometry* member : *collection) AddPolygons(*member, polygons);
  } else if (const auto* surface = dynamic_cast<const OGRPolyhedralSurface*>(&geometry)) {
    for (const OGRPolygon* face : *surface) AddPolygons(*face, polygons);
  }
}

void AddLines(const OGRGeometry& geometry, std::vector<Polygon>& lines) {
  if (const auto* point = dynamic_cast<const OGRPoint*>(&geometry)) {
    if (!point->IsEmpty()) lines.push_back({{{{point->getX(), point->getY()}}}});
  } else if (const auto* line = dynamic_cast<const OGRLineString*>(&geometry)) {
    Ring& ring = lines.emplace_back().rings.emplace_back();
    for (int i = 0; i < line->getNumPoints(); ++i) ring.emplace_back(line->getX(i), line->getY(i));
    if (ring.empty()) lines.pop_back();
  } else if (const auto* collection = dynamic_cast<const OGRGeometryCollection*>(&geometry)) {
    for (const OGRGeometry* member : *collection) AddLines(*member, lines);
  }
}

std::vector<Polygon> PolygonsOrNone(const std::unique_ptr<OGRGeometry>& geometry) {
  return geometry ? OrientedPolygons(*geometry) : std::vector<Polygon>{};
}

}  // namespace

GDALDatasetUniquePtr OpenDataset(const std::filesystem::path& path, unsigned flags,
                                 const std::vector<std::string>& options) {
  if (!std::filesystem::exists(path)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: there is no such file", path.string()),
                "check the path of the file");
  }
  static const bool registered = (GDALAllRegister(), true);
  static_cast<void>(registered);
  const QuietGdal quiet;
  CPLStringList list;
  for (const std::string& option : options) list.AddString(option.c_str());
  GDALDatasetUniquePtr dataset(
      GDALDataset::Open(path.c_str(), flags | GDAL_OF_READONLY, nullptr, list.List(), nullptr));
  if (dataset) return dataset;
  const std::string reason = QuietGdal::Message();
  throw Error(
      ErrorKind::kBadInput,
      fmt::format("{}: cannot be read as a {}{}{}", path.string(),
                  flags & GDAL_OF_RASTER ? "raster" : "map", reason.empty() ? "" : ": ", reason),
      flags & GDAL_OF_RASTER ? "give a GeoTIFF or another raster that `gdalinfo` can read"
                             : "give GeoJSON, GeoPackage, Shapefile, OSM XML or PBF, or CityJSON");
}

std::unique_ptr<OGRPolygon> ToOgr(const Polygon& polygon) {
  auto result = std::make_unique<OGRPolygon>();
  for (const Ring& ring : polygon.rings) {
    auto line = std::make_unique<OGRLinearRing>();
    line->setNumPoints(static_cast<int>(ring.size()));
    for (size_t i = 0; i < ring.size(); ++i) {
      line->setPoint(static_cast<int>(i), ring[i].x(), ring[i].y());
    }
    line->closeRings();
    result->addRingDirectly(line.release());
  }
  return result;
}

std::unique_ptr<OGRMultiPolygon> ToOgr(const std::vector<Polygon>& polygons) {
  auto result = std::make_unique<OGRMultiPolygon>();
  for (const Polygon& polygon : polygons) result->addGeometryDirectly(ToOgr(polygon).release());
  return result;
}

std::vector<Polygon> RawPolygons(const OGRGeometry& geometry) {
  std::vector<Polygon> polygons;
  if (geometry.hasCurveGeometry(TRUE)) {
    const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
    if (linear) AddPolygons(*linear, polygons);
  } else {
    AddPolygons(geometry, polygons);
  }
  return polygons;
}

std::vector<Polygon> RawLines(const OGRGeometry& geometry) {
  std::vector<Polygon> lines;
  const std::unique_ptr<OGRGeometry> linear(geometry.getLinearGeometry());
  if (linear) AddLines(*linear, lines);
  return lines;
}

bool HasOpenRing(const OGRGeometry& geometry) {
  if (const auto* polygon = dynamic_cast<const OGRPolygon*>(&geometry)) {
    for (const OGRLinearRing* ring : *polygon) {
      if (!ring->get_IsClosed()) return true;
    }
  } else if (const auto* collection = dynamic_cast<const OGRGeometryCollection*>(&geometry)) {
    for (const OGRGeometry* member : *collection) {
      if (HasOpenRing(*member)) return true;
    }
  }
  return false;
}

std::vector<Polygon> OrientedPolygons(const OGRGeometry& geometry) {
  std::vector<Polygon> polygons = RawPolygons(geometry);
  for (Polygon& polygon : polygons) {
    for (size_t i = 0; i < polygon.rings.size(); ++i) {
      Ring& ring = polygon.rings[i];
      if ((SignedArea(ring) > 0) != (i == 0)) std::reverse(ring.begin(), ring.end());
    }
  }
  return polygons;
}

std::unique_ptr<OGRGeometry> MadeValid(const OGRGeometry& geometry) {
  const QuietGdal quiet;
  if (geometry.IsValid()) return std::unique_ptr<OGRGeometry>(geometry.clone());
  CPLStringList options;
  options.SetNameValue("METHOD", "STRUCTURE");
  return std::unique_ptr<OGRGeometry>(geometry.MakeValid(options.List()));
}

std::vector<Polygon> Union(const std::vector<Polygon>& polygons) {
  const QuietGdal quiet;
  return PolygonsOrNone(std::unique_ptr<OGRGeometry>(ToOgr(polygons)->UnionCascaded()));
}

std::vector<Polygon> Difference(const Polygon& from, const std::vector<Polygon>& what) {
  const QuietGdal quiet;
  std::unique_ptr<OGRGeometry> cut(ToOgr(what)->UnionCascaded());
  if (!cut) return {from};
  return PolygonsOrNone(std::unique_ptr<OGRGeometry>(ToOgr(from)->Difference(cut.get())));
}

std::vector<Polygon> Intersection(const Polygon& a, const Polygon& b) {
  const QuietGdal quiet;
  return PolygonsOrNone(std::unique_ptr<OGRGeometry>(ToOgr(a)->Intersection(ToOgr(b).get())));
}

std::vector<Polygon> Around(const Ring& line, double radius_m) {
  const QuietGdal quiet;
  OGRLineString string;
  for (const Eigen::Vector2d& point : line) string.addPoint(point.x(), point.y());
  // GEOS puts the corners of a circle on it; here its sides shall be.
  constexpr int kQuarterCircle = 4;
  const double radius = radius_m / std::cos(std::numbers::pi / (4 * kQuarterCircle));
  if (line.size() > 1) {
    return PolygonsOrNone(std::unique_ptr<OGRGeometry>(string.Buffer(radius, kQuarterCircle)));
  }
  const OGRPoint point(line.front().x(), line.front().y());
  return PolygonsOrNone(std::unique_ptr<OGRGeometry>(point.Buffer(radius, kQuarterCircle)));
}

std::vector<Polygon> Around(const Polygon& polygon, double radius_m) {
  constexpr int kQuarterCircle = 2;
  const QuietGdal quiet;
  return PolygonsOrNone(
      std::unique_ptr<OGRGeometry>(ToOgr(polygon)->Buffer(radius_m, kQuarterCircle)));
}

double SharedArea(const Polygon& a, const Polygon& b) {
  double area = 0;
  for (const Polygon& polygon : Intersection(a, b)) area += Area(polygon);
  return area;
}

bool InteriorsMeet(const Polygon& a, const Polygon& b) {
  const QuietGdal quiet;
  const auto first = ToOgr(a);
  const auto second = ToOgr(b);
  return first->Intersects(second.get()) && !first->Touches(second.get());
}

}  // namespace stucco::plan::internal
