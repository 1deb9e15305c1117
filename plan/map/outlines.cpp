// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/internal/outlines.h"

#include <algorithm>

#include "plan/map/internal/noding.h"
#include "plan/map/internal/ogr.h"
#include "site/facades.h"
#include "survey/geometry2d.h"
#include "survey/quiet_gdal.h"

namespace stucco::plan::internal {
namespace {

constexpr double kLeastArea_m2 = 1;
constexpr double kLeastWidth_m = 0.2;

// False for rings that cannot be one.
bool RemoveBadCorners(Polygon& polygon) {
  for (Ring& ring : polygon.rings) {
    if (std::any_of(ring.begin(), ring.end(),
                    [](const Eigen::Vector2d& corner) { return !corner.allFinite(); })) {
      return false;
    }
    ring = Tidied(ring);
  }
  if (polygon.rings.empty() || polygon.rings[0].size() < 3) return false;
  std::erase_if(polygon.rings, [](const Ring& ring) { return ring.size() < 3; });
  return true;
}

void DropSmallHoles(Polygon& polygon, bool& dropped) {
  const auto small = [](const Ring& ring) { return -SignedArea(ring) < kLeastArea_m2; };
  const size_t before = polygon.rings.size();
  polygon.rings.erase(std::remove_if(polygon.rings.begin() + 1, polygon.rings.end(), small),
                      polygon.rings.end());
  dropped = dropped || polygon.rings.size() != before;
}

void Simplify(Polygon& polygon) {
  for (Ring& ring : polygon.rings) ring = Simplified(ring, kSnap_m);
}

std::vector<Polygon> Valid(const Polygon& polygon, bool& was_invalid) {
  const auto geometry = ToOgr(polygon);
  const QuietGdal quiet;
  if (geometry->IsValid()) return OrientedPolygons(*geometry);
  was_invalid = true;
  const auto valid = MadeValid(*geometry);
  return valid ? OrientedPolygons(*valid) : std::vector<Polygon>{};
}

}  // namespace

bool IsSliver(const Polygon& polygon) {
  double around = 0;
  for (const Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      around += (ring[(i + 1) % ring.size()] - ring[i]).norm();
    }
  }
  const double area = Area(polygon);
  return !(area >= kLeastArea_m2) || !(2 * area >= kLeastWidth_m * around);
}

std::vector<Polygon> ValidParts(const Polygon& polygon) {
  bool was_invalid = false;
  bool dropped = false;
  if (polygon.rings.empty()) return {};
  std::vector<Polygon> parts = Valid(polygon, was_invalid);
  std::erase_if(parts, IsSliver);
  for (Polygon& part : parts) DropSmallHoles(part, dropped);
  return parts;
}

std::vector<Polygon> CleanOutlines(const MapFeature& feature, RepairLog& repairs) {
  const std::string& building = feature.building;
  if (feature.has_open_ring) repairs.Add(building, "contour was open; closed");
  std::vector<Polygon> outlines;
  bool crossed = false;
  bool filled = false;
  for (Polygon polygon : feature.polygons) {
    if (!RemoveBadCorners(polygon)) {
      repairs.Add(building, "a contour without area or place left out");
      continue;
    }
    for (Polygon& part : Valid(polygon, crossed)) {
      DropSmallHoles(part, filled);
      outlines.push_back(std::move(part));
    }
  }
  if (crossed) repairs.Add(building, "contour crosses itself; repaired");
  if (filled) repairs.Add(building, "holes of less than 1 m2 filled");
  if (outlines.size() > 1) outlines = Union(outlines);
  std::vector<Polygon> simple;
  for (Polygon& outline : outlines) {
    Simplify(outline);
    for (Polygon& part : ValidParts(outline)) simple.push_back(std::move(part));
  }
  if (simple.size() < outlines.size()) {
    repairs.Add(building, !simple.empty()   ? "a sliver of it left out"
                          : feature.is_part ? "a part of under 1 m2 or 20 cm width left out"
                                            : "under 1 m2 or 20 cm width; left out");
  }
  return simple;
}

}  // namespace stucco::plan::internal
