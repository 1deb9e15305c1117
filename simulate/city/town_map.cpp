// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/city/town_map.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>

#include "plan/map/read_site.h"
#include "simulate/city/footprints.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/plan_frame.h"

namespace stucco::simulate {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kTerrainMargin_m = 200;
constexpr double kTerrainStep_m = 1;

// Longitude and latitude with 0.1 mm.
std::string Position(const Georef& georef, const Vector2d& corner) {
  const Vector3d geodetic = GeodeticFromEnu(georef, {corner.x(), corner.y(), 0});
  return fmt::format("[{:.9f},{:.9f}]", geodetic.y(), geodetic.x());
}

std::string RingText(const Georef& georef, const Ring& ring) {
  std::string text = "[";
  for (const Vector2d& corner : ring) text += Position(georef, corner) + ",";
  return text + Position(georef, ring[0]) + "]";
}

double TopOf(const House& house) {
  double top = house.eaves_m() + (house.roof == RoofShape::kFlat ? house.parapet_m : 0);
  for (const Vector3d& vertex : SolidOf(house).vertices) top = std::max(top, vertex.z());
  return top;
}

const char* NameOf(RoofShape roof) {
  switch (roof) {
    case RoofShape::kFlat:
      return "flat";
    case RoofShape::kGabled:
      return "gabled";
    case RoofShape::kHipped:
      return "hipped";
  }
  return "";
}

std::string Feature(const House& house, const Georef& georef) {
  std::string rings;
  for (const Ring& ring : house.outline.rings) {
    rings += (rings.empty() ? "" : ",") + RingText(georef, ring);
  }
  const int number = std::stoi(house.id.substr(1));
  return fmt::format(
      R"({{"type":"Feature","properties":{{"id":{},"building":"yes","height":{:.3f},)"
      R"("building:levels":{},"roof:shape":"{}"}},"geometry":{{"type":"Polygon","coordinates":[{}]}}}})",
      number, TopOf(house) - house.base_m, house.storeys, NameOf(house.roof), rings);
}

struct Wall {
  size_t house;
  size_t edge;
  Vector2d a, b;
};

std::vector<Wall> FreeWalls(const Town& town) {
  std::vector<Wall> walls;
  for (size_t h = 0; h < town.houses.size(); ++h) {
    const std::vector<OutlineEdge> edges = EdgesOf(town.houses[h].outline);
    for (size_t i = 0; i < edges.size(); ++i) {
      if (!town.houses[h].party[i]) walls.push_back({h, i, edges[i].a, edges[i].b});
    }
  }
  return walls;
}

Vector2d ToScene(const Georef& georef, const PlanOrigin& origin, const Vector2d& position) {
  const Geodetic place = GeodeticFromPlan(origin, position);
  return EnuFromGeodetic(georef, place.latitude_deg, place.longitude_deg, georef.origin_height_m)
      .head<2>();
}

}  // namespace

void WriteMap(const Town& town, const Georef& georef, const std::filesystem::path& path) {
  std::string text = "{\"type\":\"FeatureCollection\",\"name\":\"buildings\",\"features\":[\n";
  for (size_t i = 0; i < town.houses.size(); ++i) {
    text += Feature(town.houses[i], georef) + (i + 1 < town.houses.size() ? ",\n" : "\n");
  }
  WriteFileAtomically(path, text + "]}\n");
}

void WriteTerrain(const Town& town, const Georef& georef, const std::filesystem::path& path) {
  double reach = 0;
  for (const GroundPatch& patch : town.ground) {
    reach = std::max({reach, patch.low.norm(), patch.high.norm()});
  }
  reach += kTerrainMargin_m;
  const Vector3d north_west = GeodeticFromEnu(georef, {-reach, reach, 0});
  const Vector3d south_east = GeodeticFromEnu(georef, {reach, -reach, 0});
  const int side = static_cast<int>(2 * reach / kTerrainStep_m);
  const double step_longitude = (south_east.y() - north_west.y()) / side;
  const double step_latitude = (south_east.x() - north_west.x()) / side;
  std::vector<float> heights;
  for (int row = 0; row < side; ++row) {
    for (int column = 0; column < side; ++column) {
      const Vector3d at =
          EnuFromGeodetic(georef, north_west.x() + (row + 0.5) * step_latitude,
                          north_west.y() + (column + 0.5) * step_longitude, georef.origin_height_m);
      heights.push_back(
          static_cast<float>(town.relief.HeightAt(at.head<2>()) + georef.origin_height_m));
    }
  }
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName("GTiff");
  const auto fail = [&] {
    throw Error(ErrorKind::kOutOfResource, fmt::format("{}: cannot be written", path.string()),
                "check free space and permissions of the folder");
  };
  const char* compress[] = {"COMPRESS=DEFLATE", "PREDICTOR=3", nullptr};
  const GDALDatasetUniquePtr dataset(
      driver->Create(path.c_str(), side, side, 1, GDT_Float32, const_cast<char**>(compress)));
  if (!dataset) fail();
  std::array<double, 6> transform = {north_west.y(), step_longitude, 0, north_west.x(), 0,
                                     step_latitude};
  OGRSpatialReference wgs84;
  wgs84.SetWellKnownGeogCS("WGS84");
  if (dataset->SetGeoTransform(transform.data()) != CE_None ||
      dataset->SetSpatialRef(&wgs84) != CE_None ||
      dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, side, side, heights.data(), side, side,
                                          GDT_Float32, 0, 0, nullptr) != CE_None) {
    fail();
  }
}

bool StandsAboveNeighbour(const Site& site, const Facade& facade) {
  constexpr double kStep_m = 0.5;
  return facade.z_m.from_m > site.footprints[facade.footprint].z_m.from_m + kStep_m;
}

FacadeIds FindFacades(const Town& town, const Georef& georef, const std::filesystem::path& map,
                      const std::optional<std::filesystem::path>& terrain) {
  constexpr double kSame_m = 0.05;  // the planner joins corners within that
  const Site site = plan::ReadSite({.map = map, .dem = terrain}, plan::PlanOptions{});
  FacadeIds ids;
  for (const House& house : town.houses) ids.emplace_back(house.party.size());
  const std::vector<Wall> walls = FreeWalls(town);
  for (const Facade& facade : site.facades) {
    const Vector2d a = ToScene(georef, site.origin, facade.a);
    const Vector2d b = ToScene(georef, site.origin, facade.b);
    const auto wall = std::find_if(walls.begin(), walls.end(), [&](const Wall& w) {
      return (w.a - a).norm() < kSame_m && (w.b - b).norm() < kSame_m;
    });
    // The truth hides party walls whole, what rises above the lower neighbour too.
    if (wall == walls.end() && StandsAboveNeighbour(site, facade)) continue;
    if (wall == walls.end()) {
      throw Error(ErrorKind::kStageFailed,
                  fmt::format("{}: facade {} is no wall of the town", map.string(), facade.id));
    }
    ids[wall->house][wall->edge] = facade.id;
  }
  for (const Wall& wall : walls) {
    if (!ids[wall.house][wall.edge].empty()) continue;
    throw Error(ErrorKind::kStageFailed, fmt::format("{}: wall {} of {} is no facade", map.string(),
                                                     wall.edge, town.houses[wall.house].id));
  }
  return ids;
}

}  // namespace stucco::simulate
