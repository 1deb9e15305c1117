// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/islands.h"

#include <cstddef>
#include <map>

#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

// Faces that belong together: the smallest of each one's set, -1 for those left out.
template <typename Joins>
std::vector<int> SetsOfFaces(const Arrangement& arrangement, const Joins& joins) {
  DisjointSets sets(arrangement.faces.size());
  for (const Arrangement::Edge& edge : arrangement.edges) {
    if (edge.left >= 0 && edge.right >= 0 && joins(edge.left) && joins(edge.right)) {
      sets.Join(edge.left, edge.right);
    }
  }
  std::vector<int> set_of_face;
  set_of_face.reserve(arrangement.faces.size());
  for (int f = 0; f < static_cast<int>(arrangement.faces.size()); ++f) {
    set_of_face.push_back(joins(f) ? sets.Find(f) : -1);
  }
  return set_of_face;
}

// Of a face in square metres: all of it, and what lies near samples of its roof.
struct Support {
  double area = 0;
  double near = 0;
};

Support SupportOf(const Ring& face, int label, const CoverOfRoofs& cover, double far) {
  Support support{.area = SignedArea(face)};
  if (label >= static_cast<int>(cover.to_hit.size())) return support;
  const Polygon cell{{face}};
  const Eigen::AlignedBox2d box = BoundsOf(cell);
  const double side = cover.raster.cell;
  int all = 0, near = 0;
  for (double y = box.min().y() + side / 2; y < box.max().y(); y += side) {
    for (double x = box.min().x() + side / 2; x < box.max().x(); x += side) {
      const Eigen::Vector2d p(x, y);
      const int at = cover.raster.IndexAt(p);
      if (at < 0 || !Contains(cell, p)) continue;
      ++all;
      near += cover.to_hit[label][at] <= far;
    }
  }
  if (all > 0) support.near = support.area * near / all;
  return support;
}

}  // namespace

void DropIslands(const Arrangement& arrangement, const CoverOfRoofs& cover, double far,
                 const std::vector<bool>& inside, std::vector<int>& labels) {
  constexpr double kSmall = 0.25;     // of the part of the footprint
  constexpr double kSupported = 0.5;  // of the island
  if (cover.to_open.empty()) return;
  const auto parts = SetsOfFaces(arrangement, [&](int f) { return inside[f]; });
  const auto islands = SetsOfFaces(arrangement, [&](int f) { return labels[f] >= 0; });
  std::map<int, double> part_areas;
  std::map<int, Support> supports;
  for (size_t f = 0; f < labels.size(); ++f) {
    const Ring face = RingOf(arrangement, f);
    if (parts[f] >= 0) part_areas[parts[f]] += SignedArea(face);
    if (islands[f] < 0) continue;
    const Support support = SupportOf(face, labels[f], cover, far);
    supports[islands[f]].area += support.area;
    supports[islands[f]].near += support.near;
  }
  for (size_t f = 0; f < labels.size(); ++f) {
    if (islands[f] < 0 || parts[f] < 0) continue;
    const Support& support = supports[islands[f]];
    const bool is_small = support.area < kSmall * part_areas[parts[f]];
    if (is_small && support.near < kSupported * support.area) labels[f] = -1;
  }
}

}  // namespace stucco
