// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/facets.h"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>

#include "proxy/facets/facet_letter.h"
#include "proxy/facets/outline.h"

namespace stucco {
namespace {

double SeenShare(const PlaneView& view, const Polygon& polygon) {
  const PlaneRaster& raster = view.raster;
  const Eigen::AlignedBox2d box = BoundsOf(polygon);
  const Eigen::Array2d low = (box.min() - raster.origin).array() / raster.cell;
  const Eigen::Array2d high = (box.max() - raster.origin).array() / raster.cell;
  size_t inside = 0, seen = 0;
  for (int y = std::max(0, int(low.y())); y < std::min(raster.height, int(high.y()) + 1); ++y) {
    for (int x = std::max(0, int(low.x())); x < std::min(raster.width, int(high.x()) + 1); ++x) {
      if (!Contains(polygon, raster.Center(x, y))) continue;
      ++inside;
      seen += view.evidence[raster.Index(x, y)] == Evidence::kSeen;
    }
  }
  return inside == 0 ? 0 : static_cast<double>(seen) / static_cast<double>(inside);
}

FacetClass ClassOf(PlaneRole role) {
  switch (role) {
    case PlaneRole::kWall:
      return FacetClass::kWall;
    case PlaneRole::kCeiling:
      return FacetClass::kOuterFloor;
    default:
      return FacetClass::kRoof;
  }
}

}  // namespace

Facet MakeFacet(const Samples& samples, const PlaneView& view, const Polygon& polygon) {
  const PlaneFrame& frame = view.raster.frame;
  Facet facet;
  facet.facet_class = ClassOf(view.plane->role);
  facet.normal = view.plane->normal;
  facet.offset = view.plane->offset;
  for (size_t r = 0; r < polygon.rings.size(); ++r) {
    auto& ring = r == 0 ? facet.outer : facet.holes.emplace_back();
    for (const auto& p : polygon.rings[r]) ring.push_back(frame.ToWorld(p));
  }
  facet.area = Area(polygon);
  double squares = 0;
  int count = 0;
  for (const int i : view.plane->points) {
    if (!Contains(polygon, frame.ToPlane(samples.positions[i]))) continue;
    const double d = view.plane->DistanceTo(samples.positions[i]);
    squares += d * d;
    ++count;
    facet.support += samples.weights[i];
  }
  facet.rms = count > 0 ? std::sqrt(squares / count) : 0;
  facet.seen = SeenShare(view, polygon);
  facet.inferred = 1 - facet.seen;
  facet.source = "planes";
  return facet;
}

std::vector<Facet> OutlineFacets(const Samples& samples, const PlaneView& view,
                                 const std::vector<CutLine>& creases, const Tolerances& tolerances,
                                 bool ground) {
  // The ground ends where the photos end, not along lines of its own: it needs few.
  constexpr double kGroundDetails = 3;
  constexpr int kGroundLines = 24;
  constexpr double kLeastSeen = 0.35;  // an open facet must not be a guess
  OutlineOptions options;
  options.detail = tolerances.level_of_detail * (ground ? kGroundDetails : 1);
  options.min_area = tolerances.min_area * (ground ? kGroundDetails * kGroundDetails : 1);
  if (ground) options.most_lines = kGroundLines;
  options.epsilon = tolerances.epsilon;
  options.follow_creases = view.plane->role != PlaneRole::kWall;
  options.reach = tolerances.fill_gap / 2;
  // Walls end upright or level, or along long edges of their own such as gables.
  options.free_length =
      (view.plane->role == PlaneRole::kWall ? 10 : 5) * tolerances.level_of_detail;
  std::vector<Facet> facets;
  for (const Polygon& polygon :
       Outline(view.raster, view.evidence, view.to_seen, creases, options)) {
    Facet facet = MakeFacet(samples, view, polygon);
    if (ground) facet.facet_class = FacetClass::kGround;
    if (!ground && facet.seen < kLeastSeen) continue;
    facets.push_back(std::move(facet));
  }
  return facets;
}

void AssignIds(Building& building) {
  std::stable_sort(
      building.facets.begin(), building.facets.end(), [](const Facet& a, const Facet& b) {
        return a.facet_class != b.facet_class ? a.facet_class < b.facet_class : a.area > b.area;
      });
  std::map<FacetClass, int> count;
  for (Facet& facet : building.facets) {
    const int number = count[facet.facet_class]++;
    if (building.id == "G0") {
      facet.id = fmt::format("G{}", number);
    } else if (facet.facet_class == FacetClass::kWall) {
      facet.id = fmt::format("{}/W{:02}", building.id, number);
    } else {
      facet.id = fmt::format("{}/{}{}", building.id, LetterOf(facet.facet_class), number);
    }
  }
}

}  // namespace stucco
