// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/model/surface_samples.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <map>
#include <string>

#include "plan/model/cells.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr int kFewestRows = 2;
// A part whose underside is higher than this above the ground leaves ground to see below it.
constexpr double kStandsOnGround_m = 2;
// Heights of stacked parts differ by rounding.
constexpr double kSameHeight_m = 0.1;

void SampleFacade(const Site& site, int index, double spacing_m, std::vector<SurfaceSample>& out) {
  const Facade& facade = site.facades[index];
  const double length = facade.length_m();
  if (!(length > 0) || !(facade.z_m.length_m() > 0)) return;
  const int columns = std::max(1, static_cast<int>(std::lround(length / spacing_m)));
  const int rows =
      std::max(kFewestRows, static_cast<int>(std::lround(facade.z_m.length_m() / spacing_m)));
  const Eigen::Vector2d normal = facade.normal();
  for (int row = 0; row < rows; ++row) {
    const double z = facade.z_m.from_m + facade.z_m.length_m() * (row + 0.5) / rows;
    for (int column = 0; column < columns; ++column) {
      const Eigen::Vector2d at = facade.a + (column + 0.5) / columns * (facade.b - facade.a);
      out.push_back({{at.x(), at.y(), z}, {normal.x(), normal.y(), 0}, SurfaceKind::kWall, index});
    }
  }
}

// Footprints by building: only parts of one building lie above each other.
using Parts = std::map<std::string, std::vector<size_t>>;

Parts PartsOf(const Site& site) {
  Parts out;
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

void SampleRoof(const Site& site, const Parts& parts, size_t index, double spacing_m,
                std::vector<SurfaceSample>& out) {
  const Footprint& footprint = site.footprints[index];
  if (footprint.outline.rings.empty() || footprint.outline.rings.front().empty()) return;
  std::vector<Eigen::Vector2d> points;
  for (const Cell& cell : CellsInside(footprint.outline, spacing_m)) {
    points.push_back(CenterOf(cell, spacing_m));
  }
  if (points.empty()) points.push_back(PointInside(footprint.outline));
  const std::vector<size_t>& stack = parts.at(footprint.building);
  for (const Eigen::Vector2d& at : points) {
    if (BuiltOver(site, stack, index, at)) continue;
    out.push_back(
        {{at.x(), at.y(), footprint.z_m.to_m}, Eigen::Vector3d::UnitZ(), SurfaceKind::kRoof, -1});
  }
}

std::vector<Cell> Without(const std::vector<Cell>& cells, std::vector<Cell> taken) {
  std::ranges::sort(taken);
  std::vector<Cell> out;
  std::ranges::set_difference(cells, taken, std::back_inserter(out));
  return out;
}

void Append(std::vector<Cell>& cells, const std::vector<Cell>& more) {
  cells.insert(cells.end(), more.begin(), more.end());
}

void SampleGround(const Site& site, const SampleOptions& options, std::vector<SurfaceSample>& out) {
  const double size = options.spacing_m;
  std::vector<Cell> near, built;
  for (const Footprint& footprint : site.footprints) {
    const std::vector<Cell> inside = CellsInside(footprint.outline, size);
    if (footprint.in_area) {
      Append(near, CellsNear(footprint.outline, size, options.ground_reach_m));
      Append(near, inside);
    }
    if (inside.empty()) continue;
    const double ground = site.terrain.HeightAt(CenterOf(inside.front(), size));
    if (footprint.z_m.from_m <= ground + kStandsOnGround_m) Append(built, inside);
  }
  std::ranges::sort(near);
  near.erase(std::unique(near.begin(), near.end()), near.end());
  for (const Cell& cell : Without(near, std::move(built))) {
    const Eigen::Vector2d at = CenterOf(cell, size);
    if (!Contains(site.area, at)) continue;
    out.push_back({{at.x(), at.y(), site.terrain.HeightAt(at)},
                   Eigen::Vector3d::UnitZ(),
                   SurfaceKind::kGround,
                   -1});
  }
}

}  // namespace

std::vector<SurfaceSample> SampleSurface(const Site& site, const SampleOptions& options) {
  std::vector<SurfaceSample> out;
  for (size_t i = 0; i < site.facades.size(); ++i) {
    SampleFacade(site, static_cast<int>(i), options.spacing_m, out);
  }
  const Parts parts = PartsOf(site);
  for (size_t i = 0; i < site.footprints.size(); ++i) {
    if (site.footprints[i].in_area) SampleRoof(site, parts, i, options.spacing_m, out);
  }
  SampleGround(site, options, out);
  return out;
}

}  // namespace stucco::plan
