// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/stable_ids.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "proxy/facets/facet_letter.h"

namespace stucco {
namespace {

// Twice the area of a ring times its centroid, and twice the area, both as seen along `normal`.
std::pair<Eigen::Vector3d, double> MomentOf(const std::vector<Eigen::Vector3d>& ring,
                                            const Eigen::Vector3d& normal) {
  Eigen::Vector3d moment = Eigen::Vector3d::Zero();
  double area = 0;
  for (size_t i = 1; i + 1 < ring.size(); ++i) {
    const double part = (ring[i] - ring[0]).cross(ring[i + 1] - ring[0]).dot(normal);
    moment += part * (ring[0] + ring[i] + ring[i + 1]) / 3;
    area += part;
  }
  return {moment, area};
}

// The centroid: corners that come and go in the middle of an edge do not move it.
Eigen::Vector3d MiddleOf(const Facet& facet) {
  auto [moment, area] = MomentOf(facet.outer, facet.normal);
  for (const auto& hole : facet.holes) {
    const auto [less, hole_area] = MomentOf(hole, facet.normal);
    moment += less;  // wound the other way
    area += hole_area;
  }
  return area > 0 ? Eigen::Vector3d(moment / area) : facet.outer.front();
}

// Where a facet comes in its building: class, facade (those of none last), place.
using Place = std::tuple<FacetClass, bool, std::string, double, double>;

Place PlaceOf(const Facet& facet) {
  const Eigen::Vector3d middle = MiddleOf(facet);
  const bool of_facade = facet.facet_class == FacetClass::kWall && !facet.planned_facades.empty();
  const Eigen::Vector3d along =
      of_facade ? Eigen::Vector3d::UnitZ().cross(facet.normal) : kNumberedAlong;
  return {facet.facet_class, !of_facade, of_facade ? facet.planned_facades.front() : "",
          along.dot(middle), middle.z()};
}

// Walls of a map's building are upright: where they do not look so, z is not up.
[[maybe_unused]] bool StandsUpright(const Building& building) {
  constexpr double kLevel = 0.5;  // sine of 30 degrees, far more than any survey is tilted by
  return std::ranges::all_of(building.facets, [](const Facet& facet) {
    return facet.facet_class != FacetClass::kWall || std::abs(facet.normal.z()) < kLevel;
  });
}

}  // namespace

void AssignIdsByPlace(Building& building) {
  assert(StandsUpright(building));
  std::vector<std::pair<Place, Facet>> placed;
  for (Facet& facet : building.facets) {
    Place place = PlaceOf(facet);
    placed.emplace_back(std::move(place), std::move(facet));
  }
  std::stable_sort(placed.begin(), placed.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  building.facets.clear();
  std::map<std::string, int> parts;  // of facades
  std::map<FacetClass, int> others;
  for (auto& [place, facet] : placed) {
    const std::string& facade = std::get<2>(place);
    if (!facade.empty()) {
      facet.id = fmt::format("{}.{}", facade, ++parts[facade]);
    } else {
      const int number = others[facet.facet_class]++;
      const char letter = LetterOf(facet.facet_class);
      facet.id = facet.facet_class == FacetClass::kWall
                     ? fmt::format("{}/{}{:02}", building.id, letter, number)
                     : fmt::format("{}/{}{}", building.id, letter, number);
    }
    building.facets.push_back(std::move(facet));
  }
}

}  // namespace stucco
