// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/internal/city_in_crs.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <vector>

#include "survey/coordinate_system.h"
#include "survey/error.h"

namespace stucco {
namespace {

using Json = nlohmann::ordered_json;

// What CityJSON calls "EPSG:2056".
std::string ReferenceSystemOf(const std::string& crs) {
  const std::string code = crs.starts_with("EPSG:") ? crs.substr(5) : "";
  const bool number =
      !code.empty() && std::ranges::all_of(code, [](char c) { return c >= '0' && c <= '9'; });
  if (!number || !IsCrsOnEarth(crs)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--crs {}: is no EPSG code of a coordinate system on the earth", crs),
                "give one, as --crs EPSG:25832");
  }
  if (IsCrsGeographic(crs)) {
    throw Error(ErrorKind::kUsage,
                fmt::format("--crs {}: has degrees, and models of buildings want metres", crs),
                "give a system in metres, as --crs EPSG:25832");
  }
  return "https://www.opengis.net/def/crs/EPSG/0/" + code;
}

std::vector<Eigen::Vector3d> CornersOf(const Json& city) {
  const Json& transform = city.at("transform");
  const auto scale = transform.at("scale").get<std::vector<double>>();
  const auto translate = transform.at("translate").get<std::vector<double>>();
  std::vector<Eigen::Vector3d> corners;
  for (const Json& vertex : city.at("vertices")) {
    Eigen::Vector3d& corner = corners.emplace_back();
    for (int i = 0; i < 3; ++i) corner[i] = vertex.at(i).get<double>() * scale[i] + translate[i];
  }
  return corners;
}

void MoveToCrs(const CityFrame& frame, const std::string& crs,
               std::vector<Eigen::Vector3d>& corners) {
  const Eigen::Quaterniond world_from_city =
      Eigen::Quaterniond::FromTwoVectors(Eigen::Vector3d::UnitZ(), frame.up);
  std::vector<Geodetic> places;
  for (Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d place = GeodeticFromEnu(frame.georef, world_from_city * corner);
    places.push_back({place.x(), place.y()});
    corner.z() = place.z();
  }
  const std::vector<Eigen::Vector2d> in_map = CrsFromGeodetic(crs, places, "--crs");
  const CrsUnits units = UnitsOfCrs(crs);
  for (size_t i = 0; i < corners.size(); ++i) {
    corners[i].head<2>() = in_map[i];
    corners[i].z() /= units.vertical_m.value_or(units.horizontal_m);
    if (corners[i].allFinite()) continue;
    throw Error(ErrorKind::kBadInput, fmt::format("--crs {}: has no place for the survey", crs),
                "name the system of its country");
  }
}

void WriteCorners(const std::vector<Eigen::Vector3d>& corners, double scale, Json& city) {
  Eigen::AlignedBox3d box;
  for (const Eigen::Vector3d& corner : corners) box.extend(corner);
  const Eigen::Vector3d translate = box.min().array().floor();
  Json vertices = Json::array();
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d whole = (corner - translate) / scale;
    vertices.push_back({std::llround(whole.x()), std::llround(whole.y()), std::llround(whole.z())});
  }
  city["vertices"] = std::move(vertices);
  city["transform"] = {{"scale", {scale, scale, scale}},
                       {"translate", {translate.x(), translate.y(), translate.z()}}};
  city["metadata"]["geographicalExtent"] = {box.min().x(), box.min().y(), box.min().z(),
                                            box.max().x(), box.max().y(), box.max().z()};
}

}  // namespace

std::string CityInCrs(const std::string& city_json, const CityFrame& frame,
                      const std::string& crs) {
  constexpr double kFiner = 0.1;
  const std::string reference_system = ReferenceSystemOf(crs);
  if (frame.georef.frame != "enu") {
    throw Error(ErrorKind::kBadInput, "the survey has no positions: it lies nowhere on the earth",
                "leave out --crs for coordinates of its own");
  }
  Json city = Json::parse(city_json);
  std::vector<Eigen::Vector3d> corners = CornersOf(city);
  MoveToCrs(frame, crs, corners);
  if (!corners.empty()) {
    WriteCorners(corners, kFiner * city.at("transform").at("scale").at(0).get<double>(), city);
  }
  city["metadata"]["title"] = "Stucco proxy";
  city["metadata"]["referenceSystem"] = reference_system;
  return city.dump() + "\n";
}

}  // namespace stucco
