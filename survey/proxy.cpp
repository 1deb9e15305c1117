// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/proxy.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <set>

#include "survey/error.h"
#include "survey/internal/json.h"

namespace stucco {
namespace {

// World coordinates stay below 10 km, where a double resolves 2e-12 m.
constexpr double kCoplanarTolerance = 1e-6;
constexpr double kUnitTolerance = 1e-6;

constexpr std::array kClasses = {FacetClass::kWall, FacetClass::kRoof, FacetClass::kGround,
                                 FacetClass::kOuterFloor};

std::optional<FacetClass> FacetClassFromName(const std::string& name) {
  for (const FacetClass facet_class : kClasses) {
    if (CityGmlName(facet_class) == name) return facet_class;
  }
  return std::nullopt;
}

// Newell's area vector, seen along the normal: positive for counter-clockwise rings. Relative to
// the first vertex, so that far coordinates cost no digits.
double SignedArea(const std::vector<Eigen::Vector3d>& ring, const Eigen::Vector3d& normal) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    sum += (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]);
  }
  return 0.5 * sum.dot(normal);
}

std::optional<std::string> FindRingProblem(const Facet& facet,
                                           const std::vector<Eigen::Vector3d>& ring, bool is_hole) {
  const char* name = is_hole ? "hole" : "outer ring";
  if (ring.size() < 3) return fmt::format("{} has {} vertices", name, ring.size());
  for (size_t i = 0; i < ring.size(); ++i) {
    const double distance = std::abs(facet.normal.dot(ring[i]) - facet.offset);
    if (!(distance <= kCoplanarTolerance)) {
      return fmt::format("vertex {} of the {} is {} off the plane", i, name, distance);
    }
  }
  const double area = SignedArea(ring, facet.normal);
  if (!(area != 0)) return fmt::format("{} has no area", name);
  if ((area < 0) != is_hole) return fmt::format("{} is wound the wrong way", name);
  return std::nullopt;
}

std::optional<std::string> FindFacetProblem(const Facet& facet) {
  if (!facet.normal.allFinite() || !(std::abs(facet.normal.norm() - 1) <= kUnitTolerance)) {
    return "normal is not of unit length";
  }
  if (auto problem = FindRingProblem(facet, facet.outer, /*is_hole=*/false)) return problem;
  for (const auto& hole : facet.holes) {
    if (auto problem = FindRingProblem(facet, hole, /*is_hole=*/true)) return problem;
  }
  for (const double share : {facet.seen, facet.inferred, facet.party}) {
    if (!(share >= 0 && share <= 1)) return "seen, inferred and party must be in [0, 1]";
  }
  return std::nullopt;
}

// Other files know buildings and facets by their ids.
std::optional<std::string> FindIdProblem(const Proxy& proxy) {
  std::set<std::string> building_ids;
  std::set<std::string> facet_ids;
  for (const Building& building : proxy.buildings) {
    if (building.id.empty()) return "a building has no id";
    if (!building_ids.insert(building.id).second) {
      return fmt::format("building {} is there twice", building.id);
    }
    for (const Facet& facet : building.facets) {
      if (facet.id.empty()) return fmt::format("a facet of building {} has no id", building.id);
      if (!facet_ids.insert(facet.id).second) {
        return fmt::format("facet {} is there twice", facet.id);
      }
    }
  }
  return std::nullopt;
}

}  // namespace

std::string CityGmlName(FacetClass facet_class) {
  switch (facet_class) {
    case FacetClass::kWall:
      return "WallSurface";
    case FacetClass::kRoof:
      return "RoofSurface";
    case FacetClass::kGround:
      return "GroundSurface";
    case FacetClass::kOuterFloor:
      return "OuterFloorSurface";
  }
  throw std::logic_error("unknown facet class");
}

std::string ElevationFile(const Building& building) {
  std::string name = building.id;
  std::ranges::replace(name, '/', '_');
  return name + ".png";
}

const std::string& FacadeName(const Facet& facet) {
  return facet.planned_facades.empty() ? facet.id : facet.planned_facades.front();
}

std::optional<std::string> FindProblem(const Proxy& proxy) {
  if (!(std::abs(proxy.up.norm() - 1) <= kUnitTolerance)) return "up is not of unit length";
  if (auto problem = FindIdProblem(proxy)) return problem;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (const auto problem = FindFacetProblem(facet)) {
        return fmt::format("facet {}: {}", facet.id, *problem);
      }
    }
  }
  return std::nullopt;
}

// The list of planned facades is two fields: `facade` is the first, or the facet's own id where
// there is none.
template <typename Archive, internal::Is<Facet> T>
static void PlannedFacadeFields(Archive& archive, T& facet) {
  std::string first = FacadeName(facet);
  std::vector<std::string> others;
  if (!facet.planned_facades.empty()) {
    others.assign(facet.planned_facades.begin() + 1, facet.planned_facades.end());
  }
  archive.Required("facade", first);
  archive.Optional("other_facades", others);
  if constexpr (Archive::kReads) {
    if (first == facet.id) return;
    facet.planned_facades = {first};
    facet.planned_facades.insert(facet.planned_facades.end(), others.begin(), others.end());
  }
}

template <typename Archive, internal::Is<Facet> T>
static void Fields(Archive& archive, T& facet) {
  archive.Required("id", facet.id);
  PlannedFacadeFields(archive, facet);
  std::string name = CityGmlName(facet.facet_class);
  archive.Required("class", name);
  if constexpr (Archive::kReads) {
    const auto known = FacetClassFromName(name);
    if (!known) archive.Fail("class", fmt::format("is \"{}\", which is no known class", name));
    facet.facet_class = *known;
  }
  archive.Required("area_m2", facet.area);
  archive.Required("rms_m", facet.rms);
  archive.Required("seen", facet.seen);
  archive.Required("inferred", facet.inferred);
  archive.Optional("party", facet.party);
  archive.Optional("support", facet.support);
  archive.Optional("source", facet.source);
  archive.Required("normal", facet.normal);
  archive.Required("offset", facet.offset);
  archive.Required("outer", facet.outer);
  archive.Optional("holes", facet.holes);
}

template <typename Archive, internal::Is<Building> T>
static void Fields(Archive& archive, T& building) {
  archive.Required("id", building.id);
  archive.Required("watertight", building.watertight);
  archive.Required("source", building.source);
  archive.Optional("detail", building.detail);
  archive.Required("facets", building.facets);
}

template <typename Archive, internal::Is<Proxy> T>
static void Fields(Archive& archive, T& proxy) {
  archive.Required("up", proxy.up);
  archive.Required("metric", proxy.metric);
  archive.Required("buildings", proxy.buildings);
  archive.Optional("findings", proxy.findings);
}

Proxy ReadProxy(const std::filesystem::path& path) {
  Proxy proxy = internal::ReadJsonFile<Proxy>(path);
  if (const auto problem = FindProblem(proxy)) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: {}", path.string(), *problem));
  }
  return proxy;
}

void WriteProxy(const Proxy& proxy, const std::filesystem::path& path) {
  assert(!FindIdProblem(proxy));
  internal::WriteJsonFile(proxy, path);
}

}  // namespace stucco
