// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "exchange/read_surfaces.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>
#include <set>
#include <string>

#include "exchange/internal/read_mesh.h"
#include "survey/city_model.h"
#include "survey/error.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

std::string ExtensionOf(const fs::path& path) {
  std::string extension = path.extension().string();
  std::ranges::transform(extension, extension.begin(),
                         [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

bool IsMesh(const fs::path& path) {
  const std::string extension = ExtensionOf(path);
  return extension == ".obj" || extension == ".glb" || extension == ".gltf";
}

std::optional<FacetClass> ClassOf(const std::string& type) {
  if (type == "WallSurface" || type == "Window" || type == "Door") return FacetClass::kWall;
  if (type == "RoofSurface") return FacetClass::kRoof;
  if (type == "GroundSurface") return FacetClass::kGround;
  if (type == "OuterFloorSurface" || type == "OuterCeilingSurface") return FacetClass::kOuterFloor;
  return std::nullopt;
}

bool IsGround(const std::string& type) {
  return type == "LandUse" || type == "TINRelief";
}

bool IsOfBuildings(const std::string& type) {
  return type.starts_with("Building") || type.starts_with("Bridge") || type == "OtherConstruction";
}

// The building that an object is a part of, by the file's ids.
std::string RootOf(const CityObject& object,
                   const std::map<std::string, const CityObject*>& by_id) {
  std::set<std::string> passed;  // parents of damaged files may go round
  const CityObject* at = &object;
  while (!at->parents.empty() && passed.insert(at->id).second) {
    const auto parent = by_id.find(at->parents.front());
    if (parent == by_id.end() || !IsOfBuildings(parent->second->type)) break;
    at = parent->second;
  }
  return at->id;
}

void Append(const CityModel& city, const CityObject& from, SurfaceObject& to) {
  for (const CitySurface& surface : from.surfaces) {
    SurfacePolygon& polygon = to.polygons.emplace_back();
    polygon.facet_class = to.is_ground ? FacetClass::kGround : ClassOf(surface.type);
    polygon.id = surface.id;
    for (const std::vector<int>& corners : surface.rings) {
      auto& ring = polygon.rings.emplace_back();
      for (const int corner : corners) ring.push_back(city.vertices[corner]);
    }
  }
}

SurfaceModel FromCity(const CityModel& city) {
  SurfaceModel model;
  model.format = "CityJSON";
  model.crs = city.crs;
  std::map<std::string, const CityObject*> by_id;
  for (const CityObject& object : city.objects) by_id.emplace(object.id, &object);
  std::map<std::string, size_t> place_of;
  std::map<std::string, int> left_out;
  for (const CityObject& object : city.objects) {
    if (object.surfaces.empty()) continue;
    if (!IsGround(object.type) && !IsOfBuildings(object.type)) {
      ++left_out[object.type];
      continue;
    }
    const std::string root = RootOf(object, by_id);
    const auto [at, is_new] = place_of.emplace(root, model.objects.size());
    if (is_new) model.objects.push_back({root, IsGround(object.type), {}});
    Append(city, object, model.objects[at->second]);
  }
  for (const auto& [type, count] : left_out) {
    model.notes.push_back(fmt::format("{} objects of type {} are left out", count, type));
  }
  return model;
}

}  // namespace

bool IsSurfaceModel(const fs::path& path) {
  std::error_code error;
  if (!fs::is_regular_file(path, error)) return false;
  return IsMesh(path) || LooksLikeCityJson(path);
}

SurfaceModel ReadSurfaceModel(const fs::path& path, UpAxis up) {
  SurfaceModel model =
      IsMesh(path) ? ReadMesh(path, up == UpAxis::kY ||
                                        (up == UpAxis::kOfFormat && ExtensionOf(path) != ".obj"))
                   : FromCity(ReadCityModel(path));
  const bool any = std::ranges::any_of(
      model.objects, [](const SurfaceObject& object) { return !object.polygons.empty(); });
  if (!any) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: has no surfaces of buildings", path.string()),
                "export the model with its faces");
  }
  return model;
}

}  // namespace stucco
