// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <span>
#include <utility>
#include <vector>

namespace stucco {

struct CutPlane {
  Eigen::Vector3d normal = Eigen::Vector3d::UnitZ();
  double offset = 0;  // normal . x = offset
};

// A box cut by planes into convex cells. Neighbouring cells share whole faces, faces share edges
// and vertices. Planes 0 to 5 are the box's (low x, high x, low y ... their normals along the
// positive axes); plane 6 + i is the i-th cutting plane.
struct Partition {
  static constexpr int kBoxPlanes = 6;
  struct Face {
    std::vector<int> loop;  // counter-clockwise seen from the side the plane's normal points to
    int plane = 0;
    int below = -1;  // cell on the side against the normal; -1: outside of the box
    int above = -1;
  };
  struct Node {
    int plane = -1;  // index into `planes`; -1: a leaf
    int above = -1;
    int below = -1;
    int cell = -1;
  };

  std::vector<CutPlane> planes;  // the box's first
  std::vector<Eigen::Vector3d> vertices;
  std::vector<Face> faces;
  std::vector<std::vector<int>> cells;  // faces of each cell
  std::vector<Node> tree;               // binary space partition; node 0 is the root

  // The cell that holds a point of the box.
  int CellAt(const Eigen::Vector3d& point) const;
  // fn(cell, length) for every cell that the segment passes through, from `a` on.
  void ForEachCrossed(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                      const std::function<void(int, double)>& fn) const;
  double AreaOf(const Face& face) const;
  double VolumeOf(int cell) const;
  Eigen::Vector3d CenterOf(int cell) const;
};

// Cuts the box by one plane after the other with exact arithmetic (each vertex is the intersection
// of three planes; Bernstein, Fussell, "Fast, exact, linear booleans", 2009, represent it so),
// until all are in or there are `most_cells` cells: planes after that are left out.
Partition PartitionBox(const Eigen::AlignedBox3d& box, std::span<const CutPlane> planes,
                       size_t most_cells);

}  // namespace stucco
