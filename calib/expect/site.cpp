// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/site.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <optional>

#include "survey/proxy.h"
#include "survey/rasterize.h"
#include "survey/triangulate.h"

namespace stucco {
namespace {

constexpr double kMargin_m = 30;      // of ground around the buildings to sample
constexpr double kFarMargin_m = 200;  // and to stop rays
constexpr double kFarCell_m = 8;
constexpr double kOffSurface_m = 0.05;  // so that a point's own surface hides it from nobody

// Middles of equal parts of [from, to], none longer than `spacing`.
std::vector<double> Middles(double from, double to, double spacing) {
  const int count = std::max(1, static_cast<int>(std::ceil((to - from) / spacing)));
  std::vector<double> middles(count);
  for (int i = 0; i < count; ++i) middles[i] = from + (to - from) * (i + 0.5) / count;
  return middles;
}

void SampleWall(const PlannedFacade& facade, int wall, double spacing_m,
                const Eigen::AlignedBox2d& area, std::vector<SitePoint>& points) {
  const Eigen::Vector2d along = facade.along();
  const Eigen::Vector2d out = facade.outwards();
  for (const double z : Middles(facade.z_m.from_m, facade.z_m.to_m, spacing_m)) {
    for (const double u : Middles(0, facade.length_m(), spacing_m)) {
      const Eigen::Vector2d place = facade.a_m + u * along + kOffSurface_m * out;
      if (!area.contains(place)) continue;
      points.push_back({{place.x(), place.y(), z}, {out.x(), out.y(), 0}, wall});
    }
  }
}

// The site from above in square cells, with the footprint that covers each or lies nearest.
struct GroundPlan {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  double cell_m = 1;
  int columns = 0;
  int rows = 0;
  std::vector<int> nearest;  // index of a footprint, -1: none
  std::vector<bool> covered;

  Eigen::Vector2i CellOf(const Eigen::Vector2d& place) const {
    return ((place - low) / cell_m).array().floor().cast<int>();
  }
  // Index of a cell; nothing beyond the edge.
  std::optional<size_t> Cell(int column, int row) const {
    if (column < 0 || row < 0 || column >= columns || row >= rows) return std::nullopt;
    return static_cast<size_t>(row) * columns + column;
  }
  Eigen::Vector2d Middle(size_t cell) const {
    return low + cell_m * Eigen::Vector2d(static_cast<double>(cell % columns) + 0.5,
                                          static_cast<double>(cell / columns) + 0.5);
  }
};

Eigen::AlignedBox2d BoundsOf(const PlannedFootprint& footprint) {
  Eigen::AlignedBox2d bounds;
  for (const Eigen::Vector2d& p : footprint.rings_m.front()) bounds.extend(p);
  return bounds;
}

// All footprints and this much around them.
Eigen::AlignedBox2d SiteArea(const Plan& plan, double margin_m) {
  Eigen::AlignedBox2d area;
  for (const PlannedFootprint& footprint : plan.footprints) area.extend(BoundsOf(footprint));
  const Eigen::Vector2d margin = Eigen::Vector2d::Constant(margin_m);
  return area.isEmpty() ? area : Eigen::AlignedBox2d(area.min() - margin, area.max() + margin);
}

GroundPlan EmptyGroundPlan(const Eigen::AlignedBox2d& area, double cell_m) {
  GroundPlan ground;
  ground.cell_m = cell_m;
  ground.low = area.min();
  ground.columns = static_cast<int>(std::ceil(area.sizes().x() / cell_m));
  ground.rows = static_cast<int>(std::ceil(area.sizes().y() / cell_m));
  const size_t count = static_cast<size_t>(ground.columns) * ground.rows;
  ground.nearest.assign(count, -1);
  ground.covered.assign(count, false);
  return ground;
}

// Marks the cells whose middle is inside the footprint; false where there are none.
bool Cover(const PlannedFootprint& footprint, int index, GroundPlan& ground) {
  const Eigen::AlignedBox2d bounds = BoundsOf(footprint);
  const Eigen::Vector2i first = ground.CellOf(bounds.min());
  const Eigen::Vector2i size = ground.CellOf(bounds.max()) - first + Eigen::Vector2i::Ones();
  bool any = false;
  std::vector<std::vector<Eigen::Vector2d>> rings = footprint.rings_m;
  for (auto& ring : rings) {
    for (Eigen::Vector2d& p : ring) p = (p - ground.low) / ground.cell_m - first.cast<double>();
  }
  const std::vector<uint8_t> inside = RasterizeRings(rings, size.x(), size.y());
  for (int row = 0; row < size.y(); ++row) {
    for (int column = 0; column < size.x(); ++column) {
      if (!inside[static_cast<size_t>(row) * size.x() + column]) continue;
      const auto cell = ground.Cell(first.x() + column, first.y() + row);
      if (!cell) continue;
      ground.covered[*cell] = true;
      ground.nearest[*cell] = index;
      any = true;
    }
  }
  return any;
}

// Hands the index of a footprint on from cell to cell.
void SpreadNearest(GroundPlan& ground) {
  std::vector<size_t> front;
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] >= 0) front.push_back(cell);
  }
  for (size_t i = 0; i < front.size(); ++i) {
    const int column = static_cast<int>(front[i] % ground.columns);
    const int row = static_cast<int>(front[i] / ground.columns);
    for (const auto& [dx, dy] : {std::pair(1, 0), {-1, 0}, {0, 1}, {0, -1}}) {
      const auto next = ground.Cell(column + dx, row + dy);
      if (!next || ground.nearest[*next] >= 0) continue;
      ground.nearest[*next] = ground.nearest[front[i]];
      front.push_back(*next);
    }
  }
}

GroundPlan MakeGroundPlan(const Plan& plan, const Eigen::AlignedBox2d& area, double cell_m) {
  GroundPlan ground = EmptyGroundPlan(area, cell_m);
  std::vector<int> small;  // cover no cell, but say how high the ground is
  for (int i = 0; i < static_cast<int>(plan.footprints.size()); ++i) {
    if (!Cover(plan.footprints[i], i, ground)) small.push_back(i);
  }
  for (const int i : small) {
    const Eigen::Vector2i place = ground.CellOf(BoundsOf(plan.footprints[i]).center());
    const auto cell = ground.Cell(place.x(), place.y());
    if (cell && ground.nearest[*cell] < 0) ground.nearest[*cell] = i;
  }
  SpreadNearest(ground);
  return ground;
}

void SampleFromAbove(const Plan& plan, double spacing_m, const Eigen::AlignedBox2d& area,
                     std::vector<SitePoint>& points) {
  const GroundPlan ground = MakeGroundPlan(plan, area, spacing_m);
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] < 0) continue;
    const Interval& z = plan.footprints[ground.nearest[cell]].z_m;
    const Eigen::Vector2d place = ground.Middle(cell);
    const double surface = ground.covered[cell] ? z.to_m : z.from_m;
    points.push_back({{place.x(), place.y(), surface + kOffSurface_m}, Eigen::Vector3d::UnitZ()});
  }
}

void AddQuad(const std::array<Eigen::Vector3d, 4>& corners, SiteMesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void AddPrism(const PlannedFootprint& footprint, SiteMesh& mesh) {
  const Interval& z = footprint.z_m;
  Facet roof;
  roof.offset = z.to_m;
  for (const auto& ring : footprint.rings_m) {
    std::vector<Eigen::Vector3d> edge;
    for (const Eigen::Vector2d& p : ring) edge.emplace_back(p.x(), p.y(), z.to_m);
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector3d& a = edge[i];
      const Eigen::Vector3d& b = edge[(i + 1) % ring.size()];
      const Eigen::Vector3d down(0, 0, z.from_m - z.to_m);
      AddQuad({a + down, b + down, b, a}, mesh);
    }
    (roof.outer.empty() ? roof.outer : roof.holes.emplace_back()) = std::move(edge);
  }
  const FacetTriangles cap = TriangulateFacet(roof);
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), cap.vertices.begin(), cap.vertices.end());
  for (const auto& t : cap.triangles) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void AddGround(const Plan& plan, SiteMesh& mesh) {
  const GroundPlan ground = MakeGroundPlan(plan, SiteArea(plan, kFarMargin_m), kFarCell_m);
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] < 0) continue;
    const Eigen::Vector2d middle = ground.Middle(cell);
    const double z = plan.footprints[ground.nearest[cell]].z_m.from_m;
    const double half = kFarCell_m / 2;
    AddQuad({Eigen::Vector3d(middle.x() - half, middle.y() - half, z),
             {middle.x() + half, middle.y() - half, z},
             {middle.x() + half, middle.y() + half, z},
             {middle.x() - half, middle.y() + half, z}},
            mesh);
  }
}

}  // namespace

std::vector<SitePoint> SampleSite(const Plan& plan, double spacing_m,
                                  const Eigen::AlignedBox2d& area) {
  std::vector<SitePoint> points;
  for (size_t i = 0; i < plan.facades.size(); ++i) {
    SampleWall(plan.facades[i], static_cast<int>(i), spacing_m, area, points);
  }
  const Eigen::AlignedBox2d above = SiteArea(plan, kMargin_m).intersection(area);
  if (!above.isEmpty()) SampleFromAbove(plan, spacing_m, above, points);
  return points;
}

SiteMesh MeshOfSite(const Plan& plan) {
  SiteMesh mesh;
  for (const PlannedFootprint& footprint : plan.footprints) AddPrism(footprint, mesh);
  if (!plan.footprints.empty()) AddGround(plan, mesh);
  return mesh;
}

}  // namespace stucco
