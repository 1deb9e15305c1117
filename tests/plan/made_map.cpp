// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/plan/made_map.h"

#include <fmt/format.h>
#include <gdal_priv.h>
#include <ogr_spatialref.h>
#include <ogrsf_frmts.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "plan/map/internal/ogr.h"
#include "survey/coordinate_system.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

using Json = nlohmann::ordered_json;

constexpr char kUtm[] = "EPSG:32633";

Geodetic Place(const Eigen::Vector2d& position) {
  return GeodeticFromPlan(OriginNear(kMadePlace), position);
}

std::vector<Polygon> OutlinesIn(const std::string& crs,
                                const std::vector<MadeBuilding>& buildings) {
  std::vector<Polygon> outlines;
  for (const MadeBuilding& building : buildings) {
    Polygon& outline = outlines.emplace_back(building.outline);
    for (Ring& ring : outline.rings) {
      std::vector<Geodetic> places;
      for (const Eigen::Vector2d& corner : ring) places.push_back(Place(corner));
      ring = CrsFromGeodetic(crs, places, "made map");
    }
  }
  return outlines;
}

GDALDriver& Driver(const std::string& name) {
  GDALAllRegister();
  GDALDriver* driver = GetGDALDriverManager()->GetDriverByName(name.c_str());
  if (driver == nullptr) throw std::runtime_error("no driver " + name);
  return *driver;
}

OGRSpatialReference Reference(const std::string& crs) {
  OGRSpatialReference reference;
  if (reference.SetFromUserInput(crs.c_str()) != OGRERR_NONE) throw std::runtime_error(crs);
  reference.SetAxisMappingStrategy(OAMS_TRADITIONAL_GIS_ORDER);
  return reference;
}

std::string Tags(const std::map<std::string, std::string>& attributes) {
  std::string tags;
  for (const auto& [key, value] : attributes) {
    tags += fmt::format("    <tag k=\"{}\" v=\"{}\"/>\n", key, value);
  }
  return tags;
}

// Protocol buffers: fields of varints and of bytes
// (https://wiki.openstreetmap.org/wiki/PBF_Format).
std::string Varint(uint64_t value) {
  std::string bytes;
  for (; value >= 0x80; value >>= 7) bytes += static_cast<char>(value | 0x80);
  return bytes + static_cast<char>(value);
}

std::string ZigZag(int64_t value) {
  return Varint(static_cast<uint64_t>(value) << 1 ^ static_cast<uint64_t>(value >> 63));
}

std::string Number(int field, uint64_t value) {
  return Varint(field << 3) + Varint(value);
}

std::string Signed(int field, int64_t value) {
  return Varint(field << 3) + ZigZag(value);
}

std::string Bytes(int field, const std::string& bytes) {
  return Varint(field << 3 | 2) + Varint(bytes.size()) + bytes;
}

std::string Block(const std::string& type, const std::string& content) {
  const std::string blob = Bytes(1, content) + Number(2, content.size());
  const std::string header = Bytes(1, type) + Number(3, blob.size());
  return std::string(3, '\0') + static_cast<char>(header.size()) + header + blob;
}

}  // namespace

void WriteGeoJson(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings) {
  Json features = Json::array();
  for (const MadeBuilding& building : buildings) {
    Json rings = Json::array();
    for (const Ring& ring : building.outline.rings) {
      Json corners = Json::array();
      for (size_t i = 0; i <= ring.size(); ++i) {
        const Geodetic place = Place(ring[i % ring.size()]);
        corners.push_back({place.longitude_deg, place.latitude_deg});
      }
      rings.push_back(corners);
    }
    features.push_back({{"type", "Feature"},
                        {"properties", building.attributes},
                        {"geometry", {{"type", "Polygon"}, {"coordinates", rings}}}});
  }
  WriteFile(path, Json{{"type", "FeatureCollection"}, {"features", features}}.dump());
}

void WriteWithOgr(const std::filesystem::path& path, const std::string& driver,
                  const std::string& crs, const std::vector<MadeBuilding>& buildings) {
  GDALDatasetUniquePtr dataset(Driver(driver).Create(path.c_str(), 0, 0, 0, GDT_Unknown, nullptr));
  if (!dataset) throw std::runtime_error(CPLGetLastErrorMsg());
  OGRSpatialReference reference = Reference(crs.empty() ? kUtm : crs);
  OGRLayer* layer = dataset->CreateLayer("buildings", crs.empty() ? nullptr : &reference,
                                         wkbMultiPolygon, nullptr);
  std::map<std::string, int> fields;
  for (const MadeBuilding& building : buildings) {
    for (const auto& [name, value] : building.attributes) {
      if (!fields.emplace(name, static_cast<int>(fields.size())).second) continue;
      OGRFieldDefn field(name.c_str(), OFTString);
      layer->CreateField(&field);
    }
  }
  const std::vector<Polygon> outlines = OutlinesIn(crs.empty() ? kUtm : crs, buildings);
  for (size_t i = 0; i < buildings.size(); ++i) {
    const auto feature = OGRFeatureUniquePtr(OGRFeature::CreateFeature(layer->GetLayerDefn()));
    for (const auto& [name, value] : buildings[i].attributes) {
      feature->SetField(fields.at(name), value.c_str());
    }
    feature->SetGeometryDirectly(internal::ToOgr(std::vector{outlines[i]}).release());
    if (layer->CreateFeature(feature.get()) != OGRERR_NONE) {
      throw std::runtime_error(CPLGetLastErrorMsg());
    }
  }
}

void WriteOsm(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings) {
  std::string nodes;
  std::string ways;
  std::string relations;
  int node = 0;
  int way = 0;
  int relation = 0;
  for (const MadeBuilding& building : buildings) {
    const bool is_relation = building.outline.rings.size() > 1;
    std::string members;
    for (size_t r = 0; r < building.outline.rings.size(); ++r) {
      const int first = node + 1;
      std::string refs;
      for (const Eigen::Vector2d& corner : building.outline.rings[r]) {
        const Geodetic place = Place(corner);
        nodes += fmt::format("  <node id=\"{}\" lat=\"{:.9f}\" lon=\"{:.9f}\" version=\"1\"/>\n",
                             ++node, place.latitude_deg, place.longitude_deg);
        refs += fmt::format("    <nd ref=\"{}\"/>\n", node);
      }
      refs += fmt::format("    <nd ref=\"{}\"/>\n", first);
      ways += fmt::format("  <way id=\"{}\" version=\"1\">\n{}{}  </way>\n", ++way, refs,
                          is_relation ? "" : Tags(building.attributes));
      members += fmt::format("    <member type=\"way\" ref=\"{}\" role=\"{}\"/>\n", way,
                             r == 0 ? "outer" : "inner");
    }
    if (!is_relation) continue;
    relations += fmt::format(
        "  <relation id=\"{}\" version=\"1\">\n{}    <tag k=\"type\" v=\"multipolygon\"/>\n{}"
        "  </relation>\n",
        ++relation, members, Tags(building.attributes));
  }
  WriteFile(path, fmt::format("<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n{}{}{}</osm>\n",
                              nodes, ways, relations));
}

void WriteOsmPbf(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings) {
  std::string strings = Bytes(1, "");  // 0 means the end of a list
  std::string nodes;
  std::string ways;
  int string = 0;
  int node = 0;
  int way = 0;
  for (const MadeBuilding& building : buildings) {
    std::string refs;
    const int first = node + 1;
    const Ring& ring = building.outline.rings.at(0);
    for (const Eigen::Vector2d& corner : ring) {
      const Geodetic position = Place(corner);
      nodes += Bytes(1, Signed(1, ++node) + Signed(8, std::llround(position.latitude_deg * 1e7)) +
                            Signed(9, std::llround(position.longitude_deg * 1e7)));
      refs += ZigZag(node == first ? first : 1);
    }
    refs += ZigZag(first - node);
    std::string keys;
    std::string values;
    for (const auto& [key, value] : building.attributes) {
      strings += Bytes(1, key) + Bytes(1, value);
      keys += Varint(++string);
      values += Varint(++string);
    }
    ways += Bytes(3, Number(1, ++way) + Bytes(2, keys) + Bytes(3, values) + Bytes(8, refs));
  }
  const std::string data = Bytes(1, strings) + Bytes(2, nodes) + Bytes(2, ways);
  WriteFile(path, Block("OSMHeader", Bytes(4, "OsmSchema-V0.6")) + Block("OSMData", data));
}

void WriteCityJson(const std::filesystem::path& path, const std::vector<MadeBuilding>& buildings) {
  Json objects = Json::object();
  Json vertices = Json::array();
  const std::vector<Polygon> outlines = OutlinesIn(kUtm, buildings);
  for (size_t b = 0; b < buildings.size(); ++b) {
    const double height = std::stod(buildings[b].attributes.at("height"));
    const auto add = [&](const Eigen::Vector2d& p, double z) {
      vertices.push_back(
          {std::llround(p.x() * 1000), std::llround(p.y() * 1000), std::llround(z * 1000)});
      return static_cast<int>(vertices.size()) - 1;
    };
    Json bottom = Json::array();
    Json top = Json::array();
    Json shell = Json::array();
    for (const Ring& ring : outlines[b].rings) {
      Json low = Json::array();
      Json high = Json::array();
      for (const Eigen::Vector2d& corner : ring) {
        low.push_back(add(corner, 200));
        high.push_back(add(corner, 200 + height));
      }
      for (size_t i = 0; i < ring.size(); ++i) {
        const size_t k = (i + 1) % ring.size();
        shell.push_back({{low[i], low[k], high[k], high[i]}});
      }
      top.push_back(high);
      std::reverse(low.begin(), low.end());
      bottom.push_back(low);
    }
    shell.push_back(top);
    shell.push_back(bottom);
    const Json solid = {{"type", "Solid"}, {"lod", "1.2"}, {"boundaries", {shell}}};
    objects[buildings[b].attributes.at("id")] = {{"type", "Building"}, {"geometry", {solid}}};
  }
  WriteFile(path, Json{{"type", "CityJSON"},
                       {"version", "2.0"},
                       {"transform", {{"scale", {0.001, 0.001, 0.001}}, {"translate", {0, 0, 0}}}},
                       {"metadata",
                        {{"referenceSystem", "https://www.opengis.net/def/crs/EPSG/0/32633"}}},
                       {"CityObjects", objects},
                       {"vertices", vertices}}
                      .dump());
}

void WriteDem(const std::filesystem::path& path, const MadeDem& dem,
              const std::function<double(double, double)>& height) {
  const int n = dem.pixels;
  GDALDatasetUniquePtr dataset(Driver("GTiff").Create(path.c_str(), n, n, 1, GDT_Float32, nullptr));
  const std::vector<Geodetic> middle = {kMadePlace};
  const Eigen::Vector2d centre = CrsFromGeodetic(dem.crs, middle, "made terrain").front();
  const Eigen::Vector2d corner = centre + Eigen::Vector2d(-n, n) * dem.step / 2;
  double place[6] = {corner.x(), dem.step, 0, corner.y(), 0, -dem.step};
  dataset->SetGeoTransform(place);
  const OGRSpatialReference reference = Reference(dem.crs);
  dataset->SetSpatialRef(&reference);
  std::vector<Eigen::Vector2d> centres;
  for (int row = 0; row < n; ++row) {
    for (int column = 0; column < n; ++column) {
      centres.push_back(corner + Eigen::Vector2d(column + 0.5, -row - 0.5) * dem.step);
    }
  }
  constexpr float kNoData = -9999;
  std::vector<float> z;
  for (const Geodetic& pixel : GeodeticFromCrs(dem.crs, centres, "made terrain")) {
    const Eigen::Vector2d position = PlanFromGeodetic(OriginNear(kMadePlace), pixel);
    const double value = height(position.x(), position.y());
    z.push_back(std::isnan(value) ? kNoData : static_cast<float>(value));
  }
  dataset->GetRasterBand(1)->SetNoDataValue(kNoData);
  if (dataset->GetRasterBand(1)->RasterIO(GF_Write, 0, 0, n, n, z.data(), n, n, GDT_Float32, 0, 0,
                                          nullptr) != CE_None) {
    throw std::runtime_error(CPLGetLastErrorMsg());
  }
}

std::string Complaint(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return fmt::format("{} | {}", error.what(), error.remedy());
  }
  return "";
}

}  // namespace stucco::plan
