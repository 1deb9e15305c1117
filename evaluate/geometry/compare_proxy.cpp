// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/compare_proxy.h"

#include <algorithm>
#include <vector>

#include "evaluate/geometry/match_facets.h"
#include "evaluate/geometry/moved.h"
#include "evaluate/geometry/part_near.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/geometry/solid_check.h"
#include "evaluate/geometry/superstructures.h"

namespace stucco::evaluate {
namespace {

constexpr size_t kSamples = 200000;
constexpr uint64_t kSampleSeed = 1;

bool IsUnderside(const Building& building, const Facet& facet) {
  return facet.facet_class == FacetClass::kGround && !IsGround(building);
}

// The facets of a proxy that can be seen.
Surface VisibleSurface(const Proxy& proxy) {
  Surface surface;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (!IsUnderside(building, facet)) Append(facet, surface);
    }
  }
  return surface;
}

// Ground counts near buildings only.
Surface Surveyed(const Surface& surface, const SurfaceIndex& buildings) {
  Surface ground, surveyed;
  for (size_t i = 0; i < surface.triangles.size(); ++i) {
    Surface& part = surface.groups[i] == static_cast<int>(FacetClass::kGround) ? ground : surveyed;
    part.triangles.push_back(surface.triangles[i]);
    part.groups.push_back(surface.groups[i]);
  }
  ground.vertices = surveyed.vertices = surface.vertices;
  Append(PartNear(ground, buildings, kGroundReachM), surveyed);
  return surveyed;
}

PartFigures MeasureSurfaces(const Proxy& result, const ProxyTruth& truth, double tolerance_m,
                            int threads) {
  const SurfaceIndex& buildings = truth.scene.buildings;
  Surface planes = VisibleSurface(truth.facets);
  TruthPoints wanted;
  wanted.points = SamplePoints(Surveyed(planes, buildings), kSamples, kSampleSeed);
  wanted.showing = PhotosThatShow(wanted.points, truth.photos, truth.scene.everything,
                                  kPhotosToConfirm, threads);
  const SurfaceIndex of_result(VisibleSurface(result));
  const std::vector<double> off = Distances(Positions(wanted.points), of_result, threads);
  Append(truth.relief, planes);
  const SurfaceIndex of_truth(std::move(planes));
  const auto made = SamplePoints(Surveyed(of_result.surface(), buildings), kSamples, kSampleSeed);
  ResultPoints measured;
  measured.distances = Distances(Positions(made), of_truth, threads);
  for (const SurfacePoint& point : made) measured.groups.push_back(point.group);
  return FiguresOf(measured, wanted, off, tolerance_m);
}

void CountBuildings(const Proxy& result, ProxyFigures& figures) {
  for (const Building& building : result.buildings) {
    if (IsGround(building)) continue;
    const SolidCheck check = CheckSolid(building.facets);
    ++figures.buildings;
    figures.watertight += check.watertight();
    figures.manifold += check.manifold;
    figures.self_intersecting += check.crosses_itself;
    figures.facets += static_cast<int>(building.facets.size());
  }
}

bool IsPartOf(const std::string& facade, const Facet& facet) {
  const auto& planned = facet.planned_facades;
  return FacadeName(facet) == facade ||
         std::find(planned.begin(), planned.end(), facade) != planned.end();
}

// Whether the facet has the id that the plan gives the facade: what no plan knows has none.
bool IsNamedAs(const std::string& facade, const Facet& facet,
               std::span<const std::string> planned) {
  const bool in_plan = planned.empty() || std::ranges::find(planned, facade) != planned.end();
  return in_plan ? IsPartOf(facade, facet) : facet.planned_facades.empty();
}

double FacadeIdRate(const std::vector<TruthFacet>& matched, std::span<const std::string> planned) {
  double named = 0, all = 0;
  for (const TruthFacet& wall : matched) {
    if (!IsFacade(*wall.truth)) continue;
    double with_id = 0;
    for (const FacetMatch& match : wall.matches) {
      const bool is_named = IsNamedAs(FacadeName(*wall.truth), *match.result, planned);
      if (is_named) with_id += match.overlap_m2;
    }
    // What is below the ground need not be there. Overlaps are sums of many pieces: what is all of
    // it but for rounding is all of it.
    const double visible_m2 = wall.truth->seen * wall.area_m2;
    named += with_id > (1 - 1e-9) * visible_m2 ? visible_m2 : with_id;
    all += visible_m2;
  }
  return all > 0 ? named / all : kNotMeasured;
}

}  // namespace

bool IsGround(const Building& building) {
  return !building.facets.empty() &&
         std::all_of(building.facets.begin(), building.facets.end(),
                     [](const Facet& facet) { return facet.facet_class == FacetClass::kGround; });
}

Surface BuildingSurface(const Proxy& proxy) {
  Surface surface;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (facet.facet_class != FacetClass::kGround) Append(facet, surface);
    }
  }
  return surface;
}

ProxyFigures CompareProxy(const Proxy& result, const Similarity& truth_from_result,
                          const ProxyTruth& truth, double tolerance_m, int threads) {
  ProxyFigures figures;
  CountBuildings(result, figures);
  for (const Building& building : truth.facets.buildings) {
    if (IsGround(building)) continue;
    ++figures.truth_buildings;
    figures.truth_facets += static_cast<int>(building.facets.size());
  }
  const Proxy moved = Moved(result, truth_from_result);
  figures.superstructure_facets =
      CountSuperstructures(moved, VisibleSurface(truth.facets), SurfaceIndex(truth.relief));
  figures.surface = MeasureSurfaces(moved, truth, tolerance_m, threads);
  figures.facade_id_rate =
      FacadeIdRate(MatchFacets(result, truth.facets, truth_from_result), truth.planned_facades);
  return figures;
}

}  // namespace stucco::evaluate
