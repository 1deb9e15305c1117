// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>

#include "site/grid_cells.h"
#include "site/internal/ground_plan.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

// A part whose underside is higher than this above the ground leaves ground to see below it.
constexpr double kStandsOnGround_m = 2;
// Heights of stacked parts differ by rounding.
constexpr double kSameHeight_m = 0.1;

// Middles of `count` equal parts of [from, to].
std::vector<double> Middles(double from, double to, int count) {
  std::vector<double> middles(count);
  for (int i = 0; i < count; ++i) middles[i] = from + (to - from) * (i + 0.5) / count;
  return middles;
}

int PartsOf(double length_m, const SampleOptions& options) {
  const double parts = length_m / options.spacing_m;
  return std::max(1,
                  static_cast<int>(options.never_farther ? std::ceil(parts) : std::round(parts)));
}

bool IsWithin(const SampleOptions& options, const Eigen::Vector2d& place) {
  return !options.within || options.within->contains(place);
}

// Two ways to write the same places: they differ in the last digit, and what is planned (by shares)
// or found in photos (by distances) hangs on it here and there.
std::vector<Eigen::Vector2d> PlacesOn(const Facade& facade, const SampleOptions& options) {
  const double length = facade.length_m();
  const int count = PartsOf(length, options);
  std::vector<Eigen::Vector2d> places;
  if (options.never_farther) {
    const Eigen::Vector2d along = facade.along();
    for (const double u : Middles(0, length, count)) places.push_back(facade.a + u * along);
  } else {
    const Eigen::Vector2d whole = facade.b - facade.a;
    for (const double share : Middles(0, 1, count)) places.push_back(facade.a + share * whole);
  }
  return places;
}

void SampleFacade(const Site& site, int index, const SampleOptions& options,
                  std::vector<SurfaceSample>& out) {
  const Facade& facade = site.facades[index];
  if (!(facade.length_m() > 0) || !(facade.z_m.length_m() > 0)) return;
  const int rows = std::max(options.fewest_rows, PartsOf(facade.z_m.length_m(), options));
  const std::vector<Eigen::Vector2d> places = PlacesOn(facade, options);
  const Eigen::Vector2d normal = facade.normal();
  for (const double z : Middles(facade.z_m.from_m, facade.z_m.to_m, rows)) {
    for (const Eigen::Vector2d& place : places) {
      const Eigen::Vector2d at = place + options.off_surface_m * normal;
      if (!IsWithin(options, at)) continue;
      out.push_back({{at.x(), at.y(), z}, {normal.x(), normal.y(), 0}, SurfaceKind::kWall, index});
    }
  }
}

// Footprints by building: only parts of one building lie above each other.
using Stacks = std::map<std::string, std::vector<size_t>>;

Stacks StacksOf(const Site& site) {
  Stacks out;
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    out[site.footprints[i].building].push_back(i);
  }
  return out;
}

// Another part of the building stands on this roof there.
bool BuiltOver(const Site& site, const std::vector<size_t>& parts, size_t self,
               const Eigen::Vector2d& at) {
  const double z = site.footprints[self].z_m.to_m;
  return std::ranges::any_of(parts, [&](size_t other) {
    const Footprint& above = site.footprints[other];
    return other != self && above.z_m.from_m <= z + kSameHeight_m &&
           above.z_m.to_m > z + kSameHeight_m && Contains(above.outline, at);
  });
}

// A point inside the polygon where no cell centre is: the middle of the widest stretch of the row
// through the middle of its height.
Eigen::Vector2d PointInside(const Polygon& polygon) {
  Eigen::Vector2d low = polygon.rings.front().front(), high = low;
  for (const Eigen::Vector2d& corner : polygon.rings.front()) {
    low = low.cwiseMin(corner);
    high = high.cwiseMax(corner);
  }
  const double y = 0.5 * (low.y() + high.y());
  const int steps = 64;
  Eigen::Vector2d best = 0.5 * (low + high);
  int longest = 0, run = 0;
  for (int i = 0; i < steps; ++i) {
    const double x = low.x() + (i + 0.5) / steps * (high.x() - low.x());
    run = Contains(polygon, {x, y}) ? run + 1 : 0;
    if (run <= longest) continue;
    longest = run;
    best = {x - 0.5 * (run - 1) / steps * (high.x() - low.x()), y};
  }
  return best;
}

// On a level surface; `footprint`: of a roof, else -1.
void AddLevel(const Eigen::Vector2d& at, double z, int footprint, const SampleOptions& options,
              std::vector<SurfaceSample>& out) {
  if (!IsWithin(options, at)) return;
  out.push_back({.position = {at.x(), at.y(), z + options.off_surface_m},
                 .normal = Eigen::Vector3d::UnitZ(),
                 .kind = footprint >= 0 ? SurfaceKind::kRoof : SurfaceKind::kGround,
                 .footprint = footprint});
}

void SampleRoof(const Site& site, const Stacks& stacks, size_t index, const SampleOptions& options,
                std::vector<SurfaceSample>& out) {
  const Footprint& footprint = site.footprints[index];
  if (footprint.outline.rings.empty() || footprint.outline.rings.front().empty()) return;
  const double spacing =
      options.roof_spacings_m.empty() ? options.spacing_m : options.roof_spacings_m.at(index);
  std::vector<Eigen::Vector2d> points;
  for (const GridCell& cell : CellsInside(footprint.outline, spacing)) {
    points.push_back(CenterOf(cell, spacing));
  }
  if (points.empty()) points.push_back(PointInside(footprint.outline));
  const std::vector<size_t>& stack = stacks.at(footprint.building);
  for (const Eigen::Vector2d& at : points) {
    if (BuiltOver(site, stack, index, at)) continue;
    AddLevel(at, footprint.z_m.to_m, static_cast<int>(index), options, out);
  }
}

std::vector<GridCell> Without(const std::vector<GridCell>& cells, std::vector<GridCell> taken) {
  std::ranges::sort(taken);
  std::vector<GridCell> out;
  std::ranges::set_difference(cells, taken, std::back_inserter(out));
  return out;
}

void Append(std::vector<GridCell>& cells, const std::vector<GridCell>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

void SampleGround(const Site& site, const SampleOptions& options, std::vector<SurfaceSample>& out) {
  const double size = options.spacing_m;
  std::vector<GridCell> near, built;
  for (const Footprint& footprint : site.footprints) {
    const std::vector<GridCell> inside = CellsInside(footprint.outline, size);
    if (footprint.in_area || !options.area_only) {
      Append(near, CellsNear(footprint.outline, size, options.ground_reach_m));
      Append(near, inside);
    }
    if (inside.empty()) continue;
    const double ground = site.terrain.HeightAt(CenterOf(inside.front(), size));
    if (footprint.z_m.from_m <= ground + kStandsOnGround_m) Append(built, inside);
  }
  for (const Segment2d& line : options.ground_along) {
    Append(near, CellsNearLine(line, size, options.ground_reach_m));
  }
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const GridCell& cell : Without(near, std::move(built))) {
    const Eigen::Vector2d at = CenterOf(cell, size);
    if (options.area_only && !Contains(site.area, at)) continue;
    AddLevel(at, site.terrain.HeightAt(at), -1, options, out);
  }
}

void SampleRoofsAndTerrain(const Site& site, const SampleOptions& options,
                           std::vector<SurfaceSample>& out) {
  const Stacks stacks = StacksOf(site);
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    if (site.footprints[i].in_area || !options.area_only) {
      SampleRoof(site, stacks, i, options, out);
    }
  }
  SampleGround(site, options, out);
}

// Roofs and ground in one grid.
void SampleFromAbove(const Site& site, const SampleOptions& options,
                     std::vector<SurfaceSample>& out) {
  Eigen::AlignedBox2d area = internal::BoundsWithMargin(site, options.ground_reach_m);
  if (options.within) area = area.intersection(*options.within);
  if (area.isEmpty()) return;
  const internal::GroundPlan ground = internal::MakeGroundPlan(site, area, options.spacing_m);
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] < 0) continue;
    const Interval& z = site.footprints[ground.nearest[cell]].z_m;
    const bool is_roof = ground.covered[cell];
    const Eigen::Vector2d at = ground.Middle(cell);
    out.push_back(
        {.position = {at.x(), at.y(), (is_roof ? z.to_m : z.from_m) + options.off_surface_m},
         .normal = Eigen::Vector3d::UnitZ(),
         .kind = is_roof ? SurfaceKind::kRoof : SurfaceKind::kGround,
         .footprint = is_roof ? ground.nearest[cell] : -1});
  }
}

}  // namespace

std::vector<SurfaceSample> SampleSurface(const Site& site, const SampleOptions& options) {
  std::vector<SurfaceSample> out;
  for (size_t i = 0; i < site.facades.size(); ++i) {
    SampleFacade(site, static_cast<int>(i), options, out);
  }
  if (site.ground == GroundRule::kTerrain) {
    SampleRoofsAndTerrain(site, options, out);
  } else {
    SampleFromAbove(site, options, out);
  }
  return out;
}

}  // namespace stucco
