// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/internal/read_cityjson.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <nlohmann/json.hpp>

#include "plan/map/internal/attributes.h"
#include "plan/map/internal/ogr.h"
#include "survey/city_model.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/geometry2d.h"

namespace stucco::plan::internal {
namespace {

using Json = nlohmann::ordered_json;  // buildings without ids keep the order of the file

// Undersides that hang lower than this over the lowest ground of a building are its ground on a
// slope; higher ones are overhangs.
constexpr double kLeastOverhang_m = 3;

struct Solid {
  std::vector<CitySurface> faces;
  double lod = 0;
};

[[noreturn]] void Fail(const std::filesystem::path& path, const std::string& reason) {
  throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), reason),
              "check the file with a CityJSON validator (cjval)");
}

class Reader {
 public:
  Reader(const std::filesystem::path& path, const PlanOptions& options)
      : options_(options), city_(ReadCityModel(path)) {
    map_.path = path;
    map_.crs = city_.crs;
    for (const CityObject& object : city_.objects) object_of_.emplace(object.id, &object);
  }

  RawMap Read(const Json& json) {
    const Json& objects = json.at("CityObjects");
    for (const auto& [id, object] : objects.items()) {
      if (object.at("type") == "Building") ReadBuilding(id, object, objects);
    }
    if (map_.features.empty()) {
      throw Error(ErrorKind::kBadInput, fmt::format("{}: has no buildings", map_.path.string()),
                  "give a city model with objects of type Building");
    }
    return std::move(map_);
  }

 private:
  void ReadBuilding(const std::string& id, const Json& building, const Json& objects) {
    ++place_;
    const std::string name = ids_.Next(OwnId(id, building), place_);
    if (ids_.renamed()) map_.repairs.Add(name, internal::kRenamed);
    std::vector<Solid> solids;
    AddSolid(id, solids);
    std::vector<Solid> parts;
    if (building.contains("children")) {
      for (const Json& child : building.at("children")) {
        const auto part = objects.find(child.get<std::string>());
        if (part == objects.end() || part->at("type") != "BuildingPart") continue;
        AddSolid(part.key(), parts);
      }
    }
    // A flat outline beside parts says nothing that they do not.
    if (!parts.empty() && !solids.empty() && solids[0].lod < 1) solids.clear();
    solids.insert(solids.end(), parts.begin(), parts.end());
    if (solids.empty()) {
      map_.repairs.Add(name, "no geometry; left out");
      return;
    }
    double ground = std::numeric_limits<double>::infinity();
    for (const Solid& solid : solids) ground = std::min(ground, HeightsOf(solid).from_m);
    const size_t before = map_.features.size();
    for (const Solid& solid : solids) AddFeature(name, solid, ground);
    if (map_.features.size() == before) return;
    if (map_.features.size() == before + 1) {
      map_.features.back().is_part = false;
      UseMeasuredHeight(building, HeightsOf(solids[0]), map_.features.back());
    }
    if (options_.height_field.empty()) RaiseToRoof(building, ground, before);
  }

  // Prisms of 3D BAG end at a percentile of the points on the roof, and its attributes state others
  // (elevations): the features of a building, from `first` on, must be as high as the highest.
  void RaiseToRoof(const Json& building, double ground, size_t first) {
    static constexpr std::array kStems = {"b3_h_dak_", "b3_h_roof_", "b3_h_"};
    static constexpr std::array kSteps = {"max", "99p", "95p", "90p", "75p", "70p", "50p"};
    for (const char* name : {"b3_h_maaiveld", "b3_h_ground"}) {
      const Json value = Attribute(building, name);
      if (value.is_number()) ground = value.get<double>();
    }
    double height = 0;
    for (const char* stem : kStems) {
      for (const char* step : kSteps) {
        const Json value = Attribute(building, std::string(stem) + step);
        if (value.is_number()) height = std::max(height, value.get<double>() - ground);
      }
    }
    MapFeature& highest =
        *std::max_element(map_.features.begin() + static_cast<std::ptrdiff_t>(first),
                          map_.features.end(), [](const MapFeature& a, const MapFeature& b) {
                            return a.height_m.value_or(0) < b.height_m.value_or(0);
                          });
    if (height > highest.height_m.value_or(0)) highest.height_m = height;
  }

  std::string OwnId(const std::string& id, const Json& building) const {
    if (options_.id_field.empty()) return id;
    const Json value = Attribute(building, options_.id_field);
    return value.is_string() ? value.get<std::string>() : value.is_null() ? id : value.dump();
  }

  static Json Attribute(const Json& object, const std::string& name) {
    const auto attributes = object.find("attributes");
    if (attributes == object.end() || !attributes->contains(name)) return {};
    return attributes->at(name);
  }

  // `z` is that of the geometry.
  void UseMeasuredHeight(const Json& building, const Interval& z, MapFeature& feature) {
    const bool named = !options_.height_field.empty();
    const Json value = Attribute(building, named ? options_.height_field : "measuredHeight");
    const auto height = value.is_number()   ? std::optional(value.get<double>())
                        : value.is_string() ? ParseLength(value.get<std::string>())
                                            : std::nullopt;
    if (!height || !(*height > feature.min_height_m)) return;
    // Some files state the elevation of the roof instead.
    constexpr double kSame_m = 0.02;
    const bool is_elevation =
        std::abs(*height - z.to_m) < kSame_m && std::abs(z.from_m) > kSame_m && z.length_m() > 0;
    if (named) {
      feature.height_m = height;
    } else if (!is_elevation) {
      // It may be that of the eaves, and the geometry a block up to some percentile of the roof.
      feature.height_m = std::max(*height, feature.height_m.value_or(0));
    } else {
      map_.repairs.Add(feature.building,
                       "measuredHeight is the elevation of the roof; height of the geometry used");
    }
  }

  // What the object has of surfaces.
  void AddSolid(const std::string& id, std::vector<Solid>& solids) const {
    const CityObject& object = *object_of_.at(id);
    if (!object.surfaces.empty()) solids.push_back({object.surfaces, object.lod});
  }

  const Eigen::Vector3d& Vertex(int index) const { return city_.vertices[index]; }

  Interval HeightsOf(const Solid& solid) const {
    Interval z{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const CitySurface& face : solid.faces) {
      const Interval range = HeightsOf(face);
      z = {std::min(z.from_m, range.from_m), std::max(z.to_m, range.to_m)};
    }
    return z;
  }

  Interval HeightsOf(const CitySurface& face) const {
    Interval z{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::vector<int>& ring : face.rings) {
      for (const int index : ring) {
        z = {std::min(z.from_m, Vertex(index).z()), std::max(z.to_m, Vertex(index).z())};
      }
    }
    return z;
  }

  // Share of the face's area that is left when it is seen from above.
  double Flatness(const CitySurface& face) const {
    Eigen::Vector3d normal = Eigen::Vector3d::Zero();
    const std::vector<int>& ring = face.rings.front();
    for (size_t i = 2; i < ring.size(); ++i) {
      normal += (Vertex(ring[i - 1]) - Vertex(ring[0])).cross(Vertex(ring[i]) - Vertex(ring[0]));
    }
    return normal.norm() > 0 ? std::abs(normal.z()) / normal.norm() : 0;
  }

  // The union of faces seen from above.
  template <class Keep>
  std::vector<Polygon> Projected(const Solid& solid, const Keep& keep) const {
    std::vector<Polygon> polygons;
    for (const CitySurface& face : solid.faces) {
      if (face.rings.empty() || face.rings.front().size() < 3 || !keep(face)) continue;
      Polygon polygon;
      for (const std::vector<int>& indices : face.rings) {
        Ring& ring = polygon.rings.emplace_back();
        for (const int index : indices) ring.push_back(Vertex(index).head<2>());
      }
      if (const auto valid = MadeValid(*ToOgr(polygon))) {
        for (Polygon& part : OrientedPolygons(*valid)) polygons.push_back(std::move(part));
      }
    }
    return Union(polygons);
  }

  std::vector<Polygon> Footprint(const Solid& solid) const {
    constexpr double kSteep = 0.1;  // walls, leaning ones too
    std::vector<Polygon> ground =
        Projected(solid, [](const CitySurface& face) { return face.type == "GroundSurface"; });
    if (!ground.empty()) return ground;
    const auto area = [](const std::vector<Polygon>& polygons) {
      double sum = 0;
      for (const Polygon& polygon : polygons) sum += Area(polygon);
      return sum;
    };
    constexpr double kBottom_m = 0.5;
    constexpr double kLevel = 0.95;
    constexpr double kMostRoofOverhang = 0.8;  // of the whole that a bottom must cover
    const double bottom = HeightsOf(solid).from_m;
    ground = Projected(solid, [&](const CitySurface& face) {
      return Flatness(face) > kLevel && HeightsOf(face).to_m < bottom + kBottom_m;
    });
    std::vector<Polygon> all =
        Projected(solid, [&](const CitySurface& face) { return Flatness(face) > kSteep; });
    return area(ground) >= kMostRoofOverhang * area(all) ? ground : all;
  }

  void AddFeature(const std::string& building, const Solid& solid, double ground) {
    MapFeature feature;
    feature.building = building;
    feature.is_part = true;
    feature.polygons = Footprint(solid);
    if (feature.polygons.empty()) {
      map_.repairs.Add(building, "a part has no area seen from above; left out");
      return;
    }
    const Interval z = HeightsOf(solid);
    if (z.to_m > z.from_m) feature.height_m = z.to_m - ground;
    if (z.from_m - ground > kLeastOverhang_m) feature.min_height_m = z.from_m - ground;
    map_.features.push_back(std::move(feature));
  }

  const PlanOptions& options_;
  RawMap map_;
  CityModel city_;
  std::map<std::string, const CityObject*> object_of_;
  BuildingIds ids_;
  int place_ = 0;
};

}  // namespace

RawMap ReadCityJson(const std::filesystem::path& path, const PlanOptions& options) {
  try {
    const Json json = Json::parse(ReadFile(path));
    return Reader(path, options).Read(json);
  } catch (const nlohmann::json::exception& error) {
    Fail(path, fmt::format("is no CityJSON: {}", error.what()));
  }
}

}  // namespace stucco::plan::internal
