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
  std::string id;  // "C0001/W03", "C0001/R0", "G0"
  // Ids of the plan's facades that it is a part of or spans, the one it has most of first; empty:
  // none, or no plan.
  std::vector<std::string> planned_facades;
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
  double party = 0;     // share of the area that another building or the ground hides for good
  std::string source;   // "planes", "footprint", "extruded"
};

// The facade that a facet is named after in files for people and programs: the first of the plan's,
// else the facet itself.
const std::string& FacadeName(const Facet& facet);

struct Building {
  std::string id;  // "C0001": a cluster of the cloud; "B0001": a building of the map
  bool watertight = false;
  std::string source;  // "cloud", "map"
  // How much of a building of the map the cloud showed: "full", "coarse", "LoD1.2", "extrusion"
  // (Name() in proxy/map/map_solids.h says what they mean); empty: it is not made from the map.
  std::string detail;
  std::vector<Facet> facets;
};

// The name of a building's picture in kElevationsFolder: "B0001.png"; '/' becomes '_'.
std::string ElevationFile(const Building& building);

// The ground is a building of its own with id "G0" holding kGround facets.
struct Proxy {
  std::vector<Building> buildings;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  bool metric = false;
  // Where the plan's map and what photos show disagree, and what they show of buildings that is no
  // facet; a sentence each.
  std::vector<std::string> findings;
};

// The first ring with under 3 vertices, vertex off its plane, wrong orientation ..., or nothing.
std::optional<std::string> FindProblem(const Proxy& proxy);

// proxy/facets.json; the names in it are fixed (docs/formats.md). Throws Error (kBadInput), reading
// also where FindProblem finds one. Writing requires buildings and facets with ids, each once.
Proxy ReadProxy(const std::filesystem::path& path);
void WriteProxy(const Proxy& proxy, const std::filesystem::path& path);

}  // namespace stucco
