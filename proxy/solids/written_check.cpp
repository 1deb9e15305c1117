// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/written_check.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <set>
#include <utility>

#include "proxy/solids/closed_check.h"

namespace stucco {
namespace {

using Points = std::vector<Eigen::Vector3d>;

constexpr double kWritten_m = 0.001;  // proxy/output/cityjson
constexpr double kPlanar_m = 0.01;    // val3dity's planarity_d2p_tol

// Moves every corner by `move`; what falls together becomes one.
template <typename Move>
std::vector<Facet> WithCorners(std::vector<Facet> facets, const Move& move) {
  const auto write = [&](Points& ring) {
    for (Eigen::Vector3d& p : ring) p = move(p);
    ring.erase(std::unique(ring.begin(), ring.end()), ring.end());
    while (ring.size() > 1 && ring.front() == ring.back()) ring.pop_back();
  };
  for (Facet& facet : facets) {
    write(facet.outer);
    for (Points& hole : facet.holes) write(hole);
    std::erase_if(facet.holes, [](const Points& hole) { return hole.size() < 3; });
  }
  std::erase_if(facets, [](const Facet& facet) { return facet.outer.size() < 3; });
  return facets;
}

bool PassesTwice(const Points& ring) {
  std::set<std::array<double, 3>> corners;
  return std::ranges::any_of(ring, [&](const Eigen::Vector3d& p) {
    return !corners.insert({p.x(), p.y(), p.z()}).second;
  });
}

bool IsFlat(const Facet& facet, const Points& ring) {
  return std::ranges::all_of(ring, [&](const Eigen::Vector3d& p) {
    return std::abs(facet.normal.dot(p) - facet.offset) <= kPlanar_m;
  });
}

std::optional<std::string> FindRingFault(const Facet& facet, const Points& ring) {
  if (PassesTwice(ring)) return "a ring passes a corner twice";
  if (!IsFlat(facet, ring)) return "a facet is not planar";
  return std::nullopt;
}

std::optional<std::string> Prefixed(const char* prefix, std::optional<std::string> fault) {
  if (fault) fault->insert(0, prefix);
  return fault;
}

}  // namespace

std::optional<std::string> FindFault(const std::vector<Facet>& facets) {
  for (const Facet& facet : facets) {
    if (auto fault = FindRingFault(facet, facet.outer)) return fault;
    for (const Points& hole : facet.holes) {
      if (auto fault = FindRingFault(facet, hole)) return fault;
    }
  }
  return FindOpening(facets);
}

std::vector<Facet> Rounded(std::vector<Facet> facets, double step) {
  return WithCorners(std::move(facets), [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d((p / step).array().round() * step);
  });
}

std::optional<std::string> FindFaultAsWritten(const std::vector<Facet>& upright,
                                              const Eigen::Matrix3d& world_from_upright) {
  if (auto fault = FindFault(Rounded(upright, kWritten_m))) {
    return Prefixed("in millimetres ", std::move(fault));
  }
  std::vector<Facet> in_world = WithCorners(upright, [&](const Eigen::Vector3d& p) {
    return Eigen::Vector3d((world_from_upright * p).cast<float>().cast<double>());
  });
  for (Facet& facet : in_world) facet.normal = world_from_upright * facet.normal;
  return Prefixed("in single precision ", FindFault(in_world));
}

}  // namespace stucco
