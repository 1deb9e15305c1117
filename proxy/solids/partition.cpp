// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/solids/partition.h"

#include <cmath>
#include <limits>

namespace stucco {

int Partition::CellAt(const Eigen::Vector3d& point) const {
  int node = 0;
  while (tree[node].plane >= 0) {
    const CutPlane& plane = planes[tree[node].plane];
    node = plane.normal.dot(point) >= plane.offset ? tree[node].above : tree[node].below;
  }
  return tree[node].cell;
}

void Partition::ForEachCrossed(const Eigen::Vector3d& a, const Eigen::Vector3d& b,
                               const std::function<void(int, double)>& fn) const {
  struct Piece {
    int node;
    double from, to;  // along the segment, 0 to 1
  };
  const double length = (b - a).norm();
  std::vector<Piece> stack = {{0, 0, 1}};
  while (!stack.empty()) {
    const Piece piece = stack.back();
    stack.pop_back();
    const Node& node = tree[piece.node];
    if (node.plane < 0) {
      fn(node.cell, (piece.to - piece.from) * length);
      continue;
    }
    const CutPlane& plane = planes[node.plane];
    const double da = plane.normal.dot(a) - plane.offset;
    const double db = plane.normal.dot(b) - plane.offset;
    const double from = da + piece.from * (db - da), to = da + piece.to * (db - da);
    if (from >= 0 && to >= 0) {
      stack.push_back({node.above, piece.from, piece.to});
    } else if (from <= 0 && to <= 0) {
      stack.push_back({node.below, piece.from, piece.to});
    } else {
      const double at = da / (da - db);
      stack.push_back({to > 0 ? node.above : node.below, at, piece.to});
      stack.push_back({from > 0 ? node.above : node.below, piece.from, at});
    }
  }
}

double Partition::AreaOf(const Face& face) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  const Eigen::Vector3d& origin = vertices[face.loop[0]];
  for (size_t i = 1; i + 1 < face.loop.size(); ++i) {
    sum += (vertices[face.loop[i]] - origin).cross(vertices[face.loop[i + 1]] - origin);
  }
  return sum.norm() / 2;
}

Eigen::Vector3d Partition::CenterOf(int cell) const {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  for (const int f : cells[cell]) {
    for (const int v : faces[f].loop) {
      sum += vertices[v];
      ++count;
    }
  }
  return sum / std::max(1, count);
}

double Partition::VolumeOf(int cell) const {
  const Eigen::Vector3d center = CenterOf(cell);
  double volume = 0;
  for (const int f : cells[cell]) {
    const CutPlane& plane = planes[faces[f].plane];
    volume += AreaOf(faces[f]) * std::abs(plane.normal.dot(center) - plane.offset) /
              (3 * plane.normal.norm());
  }
  return volume;
}

}  // namespace stucco
