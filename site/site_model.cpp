// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/site_model.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "site/internal/ground_plan.h"
#include "survey/triangulate.h"

namespace stucco {
namespace {

// A ray ends this much before its point, so that the surface the point lies on does not count.
constexpr double kEndsBefore_m = 0.02;
// The ground is bilinear between samples, the mesh is not: lowered by this much, it hides points
// behind hills but no point that lies on it.
constexpr double kGroundLowered_m = 0.5;
// How far around the buildings, and in what cells, ground that is level at their feet stops rays.
constexpr double kFarMargin_m = 200;
constexpr double kFarCell_m = 8;
// A part with more air than this below it has an underside.
constexpr double kAirBelow_m = 0.5;

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;
};

void AddQuad(const std::array<Eigen::Vector3d, 4>& corners, Mesh& mesh) {
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), corners.begin(), corners.end());
  mesh.triangles.push_back({first, first + 1, first + 2});
  mesh.triangles.push_back({first, first + 2, first + 3});
}

void AddWalls(const Footprint& footprint, Mesh& mesh) {
  const auto [low, high] = footprint.z_m;
  for (const Ring& ring : footprint.outline.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      AddQuad({Eigen::Vector3d(a.x(), a.y(), low),
               {b.x(), b.y(), low},
               {b.x(), b.y(), high},
               {a.x(), a.y(), high}},
              mesh);
    }
  }
}

void AddSlab(const Polygon& outline, double z, Mesh& mesh) {
  Facet facet;
  for (size_t r = 0; r < outline.rings.size(); ++r) {
    auto& corners = r == 0 ? facet.outer : facet.holes.emplace_back();
    for (const Eigen::Vector2d& corner : outline.rings[r]) {
      corners.push_back({corner.x(), corner.y(), z});
    }
  }
  facet.normal = Eigen::Vector3d::UnitZ();
  facet.offset = z;
  const FacetTriangles part = TriangulateFacet(facet);
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  mesh.vertices.insert(mesh.vertices.end(), part.vertices.begin(), part.vertices.end());
  for (const auto& t : part.triangles) {
    mesh.triangles.push_back({first + t[0], first + t[1], first + t[2]});
  }
}

void AddTerrain(const TerrainGrid& terrain, Mesh& mesh) {
  if (terrain.IsFlat()) return;  // nothing looks at the ground from below
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      const Eigen::Vector2d at = terrain.corner + terrain.step_m * Eigen::Vector2d(column, row);
      const double z = terrain.z_m[static_cast<size_t>(row) * terrain.columns + column];
      mesh.vertices.emplace_back(at.x(), at.y(), z - kGroundLowered_m);
    }
  }
  for (int row = 0; row + 1 < terrain.rows; ++row) {
    for (int column = 0; column + 1 < terrain.columns; ++column) {
      const uint32_t corner = first + static_cast<uint32_t>(row * terrain.columns + column);
      const uint32_t above = corner + static_cast<uint32_t>(terrain.columns);
      mesh.triangles.push_back({corner, corner + 1, above + 1});
      mesh.triangles.push_back({corner, above + 1, above});
    }
  }
}

void AddLevelGround(const Site& site, Mesh& mesh) {
  const Eigen::AlignedBox2d area = internal::BoundsWithMargin(site, kFarMargin_m);
  if (area.isEmpty()) return;
  const internal::GroundPlan ground = internal::MakeGroundPlan(site, area, kFarCell_m);
  for (size_t cell = 0; cell < ground.nearest.size(); ++cell) {
    if (ground.nearest[cell] < 0) continue;
    const Eigen::Vector2d middle = ground.Middle(cell);
    const double z = site.footprints[ground.nearest[cell]].z_m.from_m;
    const double half = kFarCell_m / 2;
    AddQuad({Eigen::Vector3d(middle.x() - half, middle.y() - half, z),
             {middle.x() + half, middle.y() - half, z},
             {middle.x() + half, middle.y() + half, z},
             {middle.x() - half, middle.y() + half, z}},
            mesh);
  }
}

// Where the ground is only known by the feet of the buildings, nothing is known to stand above it.
bool HasUnderside(const Site& site, const Footprint& footprint) {
  if (site.ground != GroundRule::kTerrain) return false;
  const double ground = site.terrain.HeightAt(footprint.outline.rings.front().front());
  return footprint.z_m.from_m > ground + kAirBelow_m;
}

Mesh MeshOf(const Site& site) {
  Mesh mesh;
  for (const Footprint& footprint : site.footprints) {
    AddWalls(footprint, mesh);
    AddSlab(footprint.outline, footprint.z_m.to_m, mesh);
    if (HasUnderside(site, footprint)) AddSlab(footprint.outline, footprint.z_m.from_m, mesh);
  }
  if (site.ground == GroundRule::kTerrain) {
    AddTerrain(site.terrain, mesh);
  } else {
    AddLevelGround(site, mesh);
  }
  return mesh;
}

}  // namespace

Occluders OccludersOf(const Site& site) {
  const Mesh mesh = MeshOf(site);
  return {mesh.vertices, mesh.triangles};
}

SiteModel::SiteModel(const Site& site) : occluders_(OccludersOf(site)) {}

bool SiteModel::Sees(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d way = point - camera;
  const double distance = way.norm();
  if (!(distance > kEndsBefore_m)) return true;
  return !occluders_.Block(camera, way / distance, distance - kEndsBefore_m);
}

}  // namespace stucco
