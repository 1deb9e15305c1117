// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/geometry/compare_proxy.h"

#include <algorithm>
#include <vector>

#include "evaluate/geometry/cloud.h"
#include "evaluate/geometry/match_facets.h"
#include "evaluate/geometry/moved.h"
#include "evaluate/geometry/seen.h"
#include "evaluate/geometry/solid_check.h"

namespace stucco::evaluate {
namespace {

constexpr size_t kSamples = 200000;
constexpr uint64_t kSeed = 1;

bool IsUnderside(const Building& building, const Facet& facet) {
  return facet.facet_class == FacetClass::kGround && !IsGround(building);
}

// The facets of a proxy that can be seen; the class is the group.
Surface VisibleSurface(const Proxy& proxy) {
  Surface surface;
  for (const Building& building : proxy.buildings) {
    for (const Facet& facet : building.facets) {
      if (!IsUnderside(building, facet)) {
        Append(facet, static_cast<int>(facet.facet_class), surface);
      }
    }
  }
  return surface;
}

// Ground counts near buildings only.
std::vector<SurfacePoint> Surveyed(const std::vector<SurfacePoint>& points,
                                   const SurfaceIndex& buildings, int threads) {
  const std::vector<double> away = Distances(Positions(points), buildings, threads);
  std::vector<SurfacePoint> kept;
  for (size_t i = 0; i < points.size(); ++i) {
    const bool ground = points[i].group == static_cast<int>(FacetClass::kGround);
    if (!ground || away[i] <= kGroundReachM) kept.push_back(points[i]);
  }
  return kept;
}

// Distances of points of one side to the other, with what class each point is of.
struct Measured {
  TruthPoints points;
  std::vector<double> distances;
};

template <typename Use>
void ForClass(const Measured& measured, int facet_class, const Use& use) {
  for (size_t i = 0; i < measured.distances.size(); ++i) {
    if (facet_class < 0 || measured.points.points[i].group == facet_class) use(i);
  }
}

double ErrorOf(const Measured& result, int facet_class) {
  std::vector<double> distances;
  ForClass(result, facet_class, [&](size_t i) { distances.push_back(result.distances[i]); });
  return Quantile(std::move(distances), 0.95);
}

SurfaceFigures FiguresOf(const Measured& result, const Measured& truth, double tolerance_m,
                         int facet_class) {
  SurfaceFigures figures;
  figures.error95_m = ErrorOf(result, facet_class);
  TruthPoints points;
  std::vector<char> found;
  ForClass(truth, facet_class, [&](size_t i) {
    points.points.push_back(truth.points.points[i]);
    points.seen.push_back(truth.points.seen[i]);
    found.push_back(truth.distances[i] <= tolerance_m ? 1 : 0);
  });
  SetCompleteness(points, found, figures);
  return figures;
}

void MeasureSurfaces(const Proxy& result, const ProxyTruth& truth, double tolerance_m, int threads,
                     ProxyFigures& figures) {
  const SurfaceIndex buildings(BuildingSurface(truth.facets));
  const SurfaceIndex of_result(VisibleSurface(result));
  Surface planes = VisibleSurface(truth.facets);
  Measured wanted;
  wanted.points.points = Surveyed(SamplePoints(planes, kSamples, kSeed), buildings, threads);
  wanted.points.seen = SeenByAny(wanted.points.points, truth.photos, truth.scene, threads);
  wanted.distances = Distances(Positions(wanted.points.points), of_result, threads);
  Append(truth.relief, planes);
  const SurfaceIndex of_truth(std::move(planes));
  Measured made;
  made.points.points =
      Surveyed(SamplePoints(of_result.surface(), kSamples, kSeed), buildings, threads);
  made.distances = Distances(Positions(made.points.points), of_truth, threads);
  figures.all = FiguresOf(made, wanted, tolerance_m, -1);
  figures.wall = FiguresOf(made, wanted, tolerance_m, static_cast<int>(FacetClass::kWall));
  figures.roof = FiguresOf(made, wanted, tolerance_m, static_cast<int>(FacetClass::kRoof));
  figures.ground = FiguresOf(made, wanted, tolerance_m, static_cast<int>(FacetClass::kGround));
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
  const auto& others = facet.other_facades;
  return facet.facade == facade || std::find(others.begin(), others.end(), facade) != others.end();
}

double FacadeIdRate(const std::vector<TruthFacet>& matched) {
  double named = 0, all = 0;
  for (const TruthFacet& wall : matched) {
    if (!IsFacade(*wall.truth)) continue;
    double with_id = 0;
    for (const FacetMatch& match : wall.matches) {
      if (IsPartOf(wall.truth->facade, *match.result)) with_id += match.overlap_m2;
    }
    // Overlaps are sums of many pieces: what is all of it but for rounding is all of it.
    named += with_id > (1 - 1e-9) * wall.area_m2 ? wall.area_m2 : with_id;
    all += wall.area_m2;
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
      if (facet.facet_class != FacetClass::kGround) {
        Append(facet, static_cast<int>(facet.facet_class), surface);
      }
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
  MeasureSurfaces(Moved(result, truth_from_result), truth, tolerance_m, threads, figures);
  figures.facade_id_rate = FacadeIdRate(MatchFacets(result, truth.facets, truth_from_result));
  return figures;
}

}  // namespace stucco::evaluate
