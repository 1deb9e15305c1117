// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace stucco {

struct CitySurface {
  std::vector<std::vector<int>> rings;  // of CityModel::vertices, the outer one first
  std::string type;                     // "WallSurface" ...; empty: the file does not say
  std::string id;                       // an attribute of the surface; mostly empty
};

struct CityObject {
  std::string id;
  std::string type;  // "Building", "BuildingPart" ...
  std::vector<std::string> parents;
  // Of its most detailed geometry that has any.
  std::vector<CitySurface> surfaces;
  double lod = 0;
};

// What a CityJSON file has of surfaces.
struct CityModel {
  std::string crs;  // "EPSG:7415"; empty: the file names none
  std::vector<Eigen::Vector3d> vertices;
  std::vector<CityObject> objects;  // in the order of the file
};

// Whether a file is CityJSON, by its beginning.
bool LooksLikeCityJson(const std::filesystem::path& path);

// CityJSON 1.0, 1.1 and 2.0 (https://www.cityjson.org/specs). Instances of templates are left out.
// Throws Error (kBadInput): damaged, or a corner that is none of its vertices.
CityModel ReadCityModel(const std::filesystem::path& path);

}  // namespace stucco
