// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/city_model.h"

#include <fmt/format.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "survey/error.h"
#include "survey/files.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;  // objects keep the order of the file

constexpr char kRemedy[] = "check the file with a CityJSON validator (cjval)";

std::vector<Eigen::Vector3d> ReadVertices(const Json& json) {
  Eigen::Array3d scale(1, 1, 1);
  Eigen::Array3d translate(0, 0, 0);
  if (json.contains("transform")) {
    const Json& transform = json.at("transform");
    for (int i = 0; i < 3; ++i) {
      scale[i] = transform.at("scale").at(i).get<double>();
      translate[i] = transform.at("translate").at(i).get<double>();
    }
  }
  std::vector<Eigen::Vector3d> vertices;
  vertices.reserve(json.at("vertices").size());
  for (const Json& vertex : json.at("vertices")) {
    const Eigen::Array3d stored(vertex.at(0).get<double>(), vertex.at(1).get<double>(),
                                vertex.at(2).get<double>());
    vertices.emplace_back(stored * scale + translate);
  }
  return vertices;
}

// "https://www.opengis.net/def/crs/EPSG/0/7415" and "urn:ogc:def:crs:EPSG::7415" to "EPSG:7415".
std::string ReadCrs(const Json& json) {
  if (!json.contains("metadata")) return "";
  const Json& metadata = json.at("metadata");
  if (!metadata.contains("referenceSystem")) return "";
  std::string name = metadata.at("referenceSystem").get<std::string>();
  const size_t end = name.find_last_of("/:");
  if (end == std::string::npos || name.find("EPSG") == std::string::npos) return name;
  return "EPSG:" + name.substr(end + 1);
}

std::vector<CitySurface> MeaningsOf(const Json& semantics) {
  std::vector<CitySurface> meanings;
  for (const Json& surface : semantics.at("surfaces")) {
    CitySurface& meaning = meanings.emplace_back();
    meaning.type = surface.at("type").get<std::string>();
    const auto id = surface.find("id");
    if (id != surface.end() && id->is_string()) meaning.id = id->get<std::string>();
  }
  return meanings;
}

// Nested lists of surfaces (shells of solids, solids of multi-solids) with the list of the same
// shape that says which of the meanings each has.
void ReadSurfaces(const Json& boundaries, const Json& values,
                  const std::vector<CitySurface>& meanings, std::vector<CitySurface>& surfaces) {
  for (size_t i = 0; i < boundaries.size(); ++i) {
    const Json& item = boundaries.at(i);
    static const Json kNone;
    const Json& value = values.is_array() && i < values.size() ? values.at(i) : kNone;
    const bool is_surface = item.is_array() && !item.empty() && item.at(0).is_array() &&
                            (item.at(0).empty() || item.at(0).at(0).is_number_integer());
    if (!is_surface) {
      if (item.is_array()) ReadSurfaces(item, value, meanings, surfaces);
      continue;
    }
    const bool means = value.is_number_unsigned() && value.get<size_t>() < meanings.size();
    surfaces.push_back(means ? meanings[value.get<size_t>()] : CitySurface());
    surfaces.back().rings = item.get<std::vector<std::vector<int>>>();
  }
}

// A text in CityJSON 1.1 and later, a number before.
double LodOf(const Json& geometry) {
  if (!geometry.contains("lod")) return 0;
  const Json& lod = geometry.at("lod");
  return lod.is_string() ? std::strtod(lod.get<std::string>().c_str(), nullptr) : lod.get<double>();
}

void ReadGeometry(const Json& geometry, CityObject& object) {
  if (!geometry.contains("boundaries")) return;  // an instance of a template
  std::vector<CitySurface> meanings;
  Json values;
  if (geometry.contains("semantics") && geometry.at("semantics").is_object()) {
    meanings = MeaningsOf(geometry.at("semantics"));
    values = geometry.at("semantics").at("values");
  }
  std::vector<CitySurface> surfaces;
  ReadSurfaces(geometry.at("boundaries"), values, meanings, surfaces);
  const double lod = LodOf(geometry);
  if (surfaces.empty() || (!object.surfaces.empty() && lod <= object.lod)) return;
  object.surfaces = std::move(surfaces);
  object.lod = lod;
}

void CheckCorners(const CityModel& model, const std::filesystem::path& path) {
  const auto count = static_cast<int>(model.vertices.size());
  const auto check = [&](const CityObject& object, const std::vector<int>& ring) {
    for (const int corner : ring) {
      if (corner >= 0 && corner < count) continue;
      throw Error(
          ErrorKind::kBadInput,
          fmt::format("{}: {} names vertex {} of {}", path.string(), object.id, corner, count),
          kRemedy);
    }
  };
  for (const CityObject& object : model.objects) {
    for (const CitySurface& surface : object.surfaces) {
      for (const auto& ring : surface.rings) check(object, ring);
    }
  }
}

CityModel ReadObjects(const Json& json) {
  CityModel model;
  model.crs = ReadCrs(json);
  model.vertices = ReadVertices(json);
  for (const auto& [id, from] : json.at("CityObjects").items()) {
    CityObject& object = model.objects.emplace_back();
    object.id = id;
    object.type = from.at("type").get<std::string>();
    if (from.contains("parents")) object.parents = from.at("parents");
    if (!from.contains("geometry")) continue;
    for (const Json& geometry : from.at("geometry")) ReadGeometry(geometry, object);
  }
  return model;
}

}  // namespace

bool LooksLikeCityJson(const std::filesystem::path& path) {
  const std::string extension = path.extension().string();
  if (extension != ".json" && extension != ".cityjson") return false;
  return ReadFile(path).find("\"CityJSON\"") != std::string::npos;
}

CityModel ReadCityModel(const std::filesystem::path& path) {
  try {
    CityModel model = ReadObjects(Json::parse(ReadFile(path)));
    CheckCorners(model, path);
    return model;
  } catch (const nlohmann::json::exception& error) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: is no CityJSON: {}", path.string(), error.what()), kRemedy);
  }
}

}  // namespace stucco
