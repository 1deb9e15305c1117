// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/relief_mesh.h"

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <utility>
#include <vector>

#include "tests/texture/synthetic.h"

namespace stucco {
namespace {

using test::MakeWall;

// Cells of half a metre over a wall, heights in metres by column and row.
TexelGrid GridWith(const Facet& wall, const std::map<std::pair<int, int>, float>& heights) {
  TexelGrid grid = MakeGrid(wall, Eigen::Vector3d::UnitZ(), 0.1, 4096);
  auto relief = std::make_shared<Relief>();
  relief->cell = 0.5;
  relief->width = 8;
  relief->height = 6;
  relief->heights.assign(48, 0);
  for (const auto& [cell, height] : heights) {
    relief->heights[static_cast<size_t>(cell.second) * 8 + cell.first] = height;
  }
  grid.relief = std::move(relief);
  return grid;
}

// What lies between the mesh and the wall's plane, outwards of it, cubic metres.
double VolumeBefore(const ReliefMesh& mesh, const TexelGrid& grid) {
  double volume = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const auto at = [&](uint32_t i) -> Eigen::Vector3d {
      return mesh.vertices[i].position - grid.origin;
    };
    volume += at(a).dot(at(b).cross(at(c))) / 6;
  }
  return volume;
}

double FrontArea(const ReliefMesh& mesh, const Eigen::Vector3d& outwards) {
  double area = 0;
  for (const auto& [a, b, c] : mesh.triangles) {
    const Eigen::Vector3d p = mesh.vertices[a].position;
    const Eigen::Vector3d cross =
        (mesh.vertices[b].position - p).cross(mesh.vertices[c].position - p);
    EXPECT_GT(cross.dot(mesh.vertices[a].normal), 0);
    area += cross.dot(outwards) / 2;
  }
  return area;
}

// Directed edges that no triangle has the other way round.
std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> OpenEdges(const ReliefMesh& mesh) {
  using Place = std::array<long, 3>;
  const auto place = [&](uint32_t i) -> Place {
    const Eigen::Vector3d mm = 1000 * mesh.vertices[i].position;
    return {std::lround(mm.x()), std::lround(mm.y()), std::lround(mm.z())};
  };
  std::map<std::pair<Place, Place>, int> count;
  std::map<Place, Eigen::Vector3d> positions;
  for (const auto& triangle : mesh.triangles) {
    for (int i = 0; i < 3; ++i) {
      const uint32_t a = triangle[i], b = triangle[(i + 1) % 3];
      positions[place(a)] = mesh.vertices[a].position;
      ++count[{place(a), place(b)}];
      --count[{place(b), place(a)}];
    }
  }
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> open;
  for (const auto& [edge, times] : count) {
    if (times > 0) open.emplace_back(positions[edge.first], positions[edge.second]);
  }
  return open;
}

TEST(ReliefMesh, OfAFlatWallIsTheWall) {
  const Facet wall = MakeWall(4, 3);
  const TexelGrid grid = GridWith(wall, {});
  const ReliefMesh mesh = MeshWithRelief(wall, grid);
  EXPECT_EQ(mesh.triangles.size(), 2u);
  EXPECT_EQ(mesh.vertices.size(), 4u);
  EXPECT_NEAR(FrontArea(mesh, wall.normal), 12, 1e-9);
}

TEST(ReliefMesh, StandsOutAndLiesBack) {
  const Facet wall = MakeWall(4, 3);
  const TexelGrid grid = GridWith(wall, {{{2, 1}, 0.6f}, {{3, 1}, 0.6f}, {{6, 4}, -0.2f}});
  const ReliefMesh mesh = MeshWithRelief(wall, grid);
  EXPECT_NEAR(FrontArea(mesh, wall.normal), 12, 1e-6);
  EXPECT_NEAR(VolumeBefore(mesh, grid), 0.6 * 0.5 - 0.2 * 0.25, 1e-6);
  for (const auto& [a, b] : OpenEdges(mesh)) {  // the outline, on the wall's plane
    EXPECT_NEAR(a.y(), 0, 1e-6);
    EXPECT_NEAR(b.y(), 0, 1e-6);
  }
}

// Sides have the colour of what stands out, not of what lies behind it.
TEST(ReliefMesh, SidesLookLikeTheEdgeThatStandsOut) {
  const Facet wall = MakeWall(4, 3);
  const TexelGrid grid = GridWith(wall, {{{2, 1}, 0.6f}});
  int sides = 0;
  const ReliefMesh mesh = MeshWithRelief(wall, grid);
  for (const auto& [a, b, c] : mesh.triangles) {
    if (std::abs(mesh.vertices[a].normal.dot(wall.normal)) > 0.5) continue;
    ++sides;
    const Eigen::Vector2d texel =
        (mesh.vertices[a].texel + mesh.vertices[b].texel + mesh.vertices[c].texel) / 3;
    EXPECT_FLOAT_EQ(grid.HeightAt(texel.x(), texel.y()), 0.6) << sides;
  }
  EXPECT_EQ(sides, 8);
}

// A gable with a window, relief over its verge and beside the window.
TEST(ReliefMesh, EndsWithTheFacet) {
  Facet gable = MakeWall(4, 3);
  gable.outer = {{0, 0, 0}, {4, 0, 0}, {2, 0, 3}};
  gable.holes = {{{1.5, 0, 0.5}, {1.5, 0, 1}, {2.5, 0, 1}, {2.5, 0, 0.5}}};
  const TexelGrid grid = GridWith(
      gable, {{{0, 5}, 0.3f}, {{1, 4}, 0.3f}, {{2, 5}, -0.2f}, {{3, 4}, -0.1f}, {{7, 0}, 1.0f}});
  const ReliefMesh mesh = MeshWithRelief(gable, grid);
  EXPECT_NEAR(FrontArea(mesh, gable.normal), 6 - 0.5, 1e-6);
  for (const auto& [a, b] : OpenEdges(mesh)) {
    EXPECT_NEAR(a.y(), 0, 1e-6);
    EXPECT_NEAR(b.y(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace stucco
