// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/model/site_model.h"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

#include "survey/triangulate.h"

namespace stucco::plan {
namespace {

// A ray ends this much before its point, so that the surface the point lies on does not count.
constexpr double kEndsBefore_m = 0.02;
// The ground is bilinear between samples, the mesh is not: lowered by this much, it hides points
// behind hills but no point that lies on it.
constexpr double kGroundLowered_m = 0.5;
// A part with more air than this below it has an underside.
constexpr double kAirBelow_m = 0.5;

struct Mesh {
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<uint32_t, 3>> triangles;

  uint32_t Add(const Eigen::Vector3d& vertex) {
    vertices.push_back(vertex);
    return static_cast<uint32_t>(vertices.size() - 1);
  }
};

void AddWalls(const Footprint& footprint, Mesh& mesh) {
  for (const Ring& ring : footprint.outline.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      const uint32_t first = mesh.Add({a.x(), a.y(), footprint.z_m.from_m});
      mesh.Add({b.x(), b.y(), footprint.z_m.from_m});
      mesh.Add({b.x(), b.y(), footprint.z_m.to_m});
      mesh.Add({a.x(), a.y(), footprint.z_m.to_m});
      mesh.triangles.push_back({first, first + 1, first + 2});
      mesh.triangles.push_back({first, first + 2, first + 3});
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

void AddGround(const Terrain& terrain, Mesh& mesh) {
  if (terrain.IsFlat()) return;  // nothing looks at the ground from below
  const auto first = static_cast<uint32_t>(mesh.vertices.size());
  for (int row = 0; row < terrain.rows; ++row) {
    for (int column = 0; column < terrain.columns; ++column) {
      const Eigen::Vector2d at = terrain.corner + terrain.step_m * Eigen::Vector2d(column, row);
      const double z = terrain.z_m[static_cast<size_t>(row) * terrain.columns + column];
      mesh.Add({at.x(), at.y(), z - kGroundLowered_m});
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

Mesh MeshOf(const Site& site) {
  Mesh mesh;
  for (const Footprint& footprint : site.footprints) {
    AddWalls(footprint, mesh);
    AddSlab(footprint.outline, footprint.z_m.to_m, mesh);
    const double ground = site.terrain.HeightAt(footprint.outline.rings.front().front());
    if (footprint.z_m.from_m > ground + kAirBelow_m) {
      AddSlab(footprint.outline, footprint.z_m.from_m, mesh);
    }
  }
  AddGround(site.terrain, mesh);
  return mesh;
}

Occluders OccludersOf(const Site& site) {
  const Mesh mesh = MeshOf(site);
  return {mesh.vertices, mesh.triangles};
}

}  // namespace

SiteModel::SiteModel(const Site& site) : occluders_(OccludersOf(site)) {}

bool SiteModel::Sees(const Eigen::Vector3d& camera, const Eigen::Vector3d& point) const {
  const Eigen::Vector3d way = point - camera;
  const double distance = way.norm();
  if (!(distance > kEndsBefore_m)) return true;
  return !occluders_.Block(camera, way / distance, distance - kEndsBefore_m);
}

}  // namespace stucco::plan
