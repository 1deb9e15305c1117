// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/superstructures.h"

#include <algorithm>

namespace stucco::evaluate {
namespace {

constexpr size_t kSamplesOfFacet = 200;
constexpr uint64_t kSampleSeed = 1;
// More than a sound model is off, less than what is worth a facet stands out.
constexpr double kOnSurface_m = 0.25;
constexpr double kDown_m = 1000;

Surface RoofsOf(const Surface& planes) {
  Surface roofs;
  roofs.vertices = planes.vertices;
  for (size_t i = 0; i < planes.triangles.size(); ++i) {
    if (planes.groups[i] != static_cast<int>(FacetClass::kRoof)) continue;
    roofs.triangles.push_back(planes.triangles[i]);
    roofs.groups.push_back(planes.groups[i]);
  }
  return roofs;
}

}  // namespace

int CountSuperstructures(const Proxy& result, const Surface& planes, const SurfaceIndex& relief) {
  const SurfaceIndex of_planes(planes), roofs(RoofsOf(planes));
  const auto stands_on_roof = [&](const SurfacePoint& point) {
    const Eigen::Vector3d& p = point.position;
    return of_planes.Distance(p) > kOnSurface_m && relief.Distance(p) <= kOnSurface_m &&
           roofs.Blocked(p, p - kDown_m * Eigen::Vector3d::UnitZ());
  };
  int count = 0;
  for (const Building& building : result.buildings) {
    for (const Facet& facet : building.facets) {
      if (facet.facet_class == FacetClass::kGround) continue;
      Surface surface;
      Append(facet, surface);
      const auto points = SamplePoints(surface, kSamplesOfFacet, kSampleSeed);
      const auto on_it = std::count_if(points.begin(), points.end(), stands_on_roof);
      if (2 * on_it > static_cast<std::ptrdiff_t>(points.size())) ++count;
    }
  }
  return count;
}

}  // namespace stucco::evaluate
