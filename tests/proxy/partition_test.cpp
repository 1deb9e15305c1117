// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/partition.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <utility>

namespace stucco {
namespace {

using Eigen::Vector3d;

const Eigen::AlignedBox3d kBox(Vector3d(-1, -1, -1), Vector3d(1, 1, 1));

void ExpectSound(const Partition& partition) {
  double volume = 0;
  for (size_t c = 0; c < partition.cells.size(); ++c) {
    volume += partition.VolumeOf(static_cast<int>(c));
    // Every cell is a closed polyhedron: each edge has two of its faces.
    std::map<std::pair<int, int>, int> edges;
    for (const int f : partition.cells[c]) {
      const auto& face = partition.faces[f];
      EXPECT_TRUE(face.below == int(c) || face.above == int(c));
      for (size_t i = 0; i < face.loop.size(); ++i) {
        const int a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        ++edges[{std::min(a, b), std::max(a, b)}];
      }
    }
    for (const auto& [edge, count] : edges) EXPECT_EQ(count, 2);
    EXPECT_EQ(partition.CellAt(partition.CenterOf(static_cast<int>(c))), int(c));
  }
  EXPECT_NEAR(volume, 8, 1e-9);
  for (const auto& face : partition.faces) {
    // Counter-clockwise seen from above.
    const auto& v = partition.vertices;
    const Vector3d normal =
        (v[face.loop[1]] - v[face.loop[0]]).cross(v[face.loop[2]] - v[face.loop[1]]);
    EXPECT_GE(normal.dot(partition.planes[face.plane].normal), 0);
  }
}

TEST(PartitionBox, WithoutPlanesIsTheBox) {
  const Partition partition = PartitionBox(kBox, {}, 100);
  EXPECT_EQ(partition.cells.size(), 1u);
  EXPECT_EQ(partition.faces.size(), 6u);
  EXPECT_EQ(partition.vertices.size(), 8u);
  ExpectSound(partition);
}

TEST(PartitionBox, CutsAGridOfCells) {
  std::vector<CutPlane> planes;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double at : {-0.3, 0.4}) planes.push_back({Vector3d::Unit(axis), at});
  }
  const Partition partition = PartitionBox(kBox, planes, 100);
  EXPECT_EQ(partition.cells.size(), 27u);
  EXPECT_EQ(partition.vertices.size(), 64u);
  ExpectSound(partition);
}

TEST(PartitionBox, ManyPlanesThroughOnePointAndAlongEdges) {
  const std::vector<CutPlane> planes = {{Vector3d(1, 1, 0), 0},  {Vector3d(1, -1, 0), 0},
                                        {Vector3d(1, 0, 1), 0},  {Vector3d(0, 1, 1), 0},
                                        {Vector3d(1, 0, 0), 0},  {Vector3d(0, 0, 1), 0},
                                        {Vector3d(1, 1, 0), -2}, {Vector3d(1, 1, 1), 3}};
  ExpectSound(PartitionBox(kBox, planes, 1000));
}

TEST(PartitionBox, RandomPlanesStaySound) {
  std::mt19937_64 engine(3);
  const auto uniform = [&] { return 2 * double(engine() >> 11) * 0x1p-53 - 1; };
  std::vector<CutPlane> planes;
  for (int i = 0; i < 14; ++i) {
    planes.push_back({Vector3d(uniform(), uniform(), uniform()).normalized(), 0.6 * uniform()});
  }
  const Partition partition = PartitionBox(kBox, planes, 100000);
  EXPECT_GT(partition.cells.size(), 100u);
  ExpectSound(partition);
}

TEST(PartitionBox, StopsAtTheLimit) {
  std::vector<CutPlane> planes;
  for (int i = 0; i < 30; ++i) planes.push_back({Vector3d::UnitX(), -0.9 + 0.05 * i});
  const Partition partition = PartitionBox(kBox, planes, 10);
  EXPECT_EQ(partition.cells.size(), 10u);
  ExpectSound(partition);
}

TEST(Partition, SegmentsCrossCellsInOrderAndInFull) {
  const std::vector<CutPlane> planes = {{Vector3d::UnitX(), -0.5}, {Vector3d::UnitX(), 0.5}};
  const Partition partition = PartitionBox(kBox, planes, 100);
  std::vector<int> cells;
  double length = 0;
  partition.ForEachCrossed({-0.9, 0, 0}, {0.9, 0.1, 0}, [&](int cell, double part) {
    cells.push_back(cell);
    length += part;
  });
  ASSERT_EQ(cells.size(), 3u);
  EXPECT_EQ(cells[0], partition.CellAt({-0.9, 0, 0}));
  EXPECT_EQ(cells[2], partition.CellAt({0.9, 0, 0}));
  EXPECT_NEAR(length, std::hypot(1.8, 0.1), 1e-12);
}

}  // namespace
}  // namespace stucco
