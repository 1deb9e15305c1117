// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace stucco {

enum class FacetClass { kWall, kRoof, kGround, kOuterFloor };

std::string CityGmlName(FacetClass facet_class);  // "WallSurface", "RoofSurface", ...

// A planar polygon with holes. The outer ring is counter-clockwise seen from the side `normal`
// points to, holes clockwise; vertices are in world coordinates and within 1e-6 of the plane.
struct Facet {
  std::string id;      // "B0001/W03", "B0001/R0", "G0"
  std::string facade;  // the plan's id of the facade that it is a part of; without one, the id
  std::vector<std::string> other_facades;  // of the plan, that it spans besides
  FacetClass facet_class = FacetClass::kWall;
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();  // unit, outwards
  double offset = 0;                                  // normal . x = offset
  std::vector<Eigen::Vector3d> outer;
  std::vector<std::vector<Eigen::Vector3d>> holes;
  double area = 0;      // square metres when the frame is metric
  double rms = 0;       // distance of the support points from the plane
  int support = 0;      // number of cloud points
  double seen = 0;      // share of the area with points
  double inferred = 0;  // share of the area without: 1 - seen
  std::string source;   // "planes", "footprint", "extruded"
};

struct Building {
  std::string id;  // "B0001"
  bool watertight = false;
  std::string source;  // "cloud", "map"
  std::vector<Facet> facets;
};

// The ground is a building of its own with id "G0" holding kGround facets.
struct Proxy {
  std::vector<Building> buildings;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  bool metric = false;
};

// The first ring with under 3 vertices, vertex off its plane, wrong orientation ..., or nothing.
std::optional<std::string> FindProblem(const Proxy& proxy);

// proxy/facets.json; the names in it are fixed (docs/formats.md). Throws Error (kBadInput).
Proxy ReadProxy(const std::filesystem::path& path);
void WriteProxy(const Proxy& proxy, const std::filesystem::path& path);

}  // namespace stucco
