// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/inner_walls.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace stucco {
namespace {

// The part of a line that a wall takes, along its direction.
struct Extent {
  double from = std::numeric_limits<double>::max();
  double to = std::numeric_limits<double>::lowest();
};

// How much higher the roof on the left of an edge is than that on its right, in its middle.
double StepOver(const Arrangement& arrangement, const Arrangement::Edge& edge,
                std::span<const RoofPlane> roofs, const std::vector<int>& labels) {
  constexpr double kLow = -1e9;  // where nothing stands
  const Eigen::Vector2d middle =
      (arrangement.vertices[edge.from] + arrangement.vertices[edge.to]) / 2;
  const auto height = [&](int face) {
    return face < 0 || labels[face] < 0 ? kLow : roofs[labels[face]].At(middle);
  };
  return height(edge.left) - height(edge.right);
}

// Walls that stand along a line for a short way only.
class ShortWalls {
 public:
  ShortWalls(const Arrangement& arrangement, std::span<const CutLine> lines,
             std::span<const RoofPlane> roofs)
      : arrangement_(arrangement), roofs_(roofs), edges_(lines.size()) {
    for (size_t e = 0; e < arrangement.edges.size(); ++e) {
      const Arrangement::Edge& edge = arrangement.edges[e];
      if (edge.line >= 0) edges_[edge.line].push_back(static_cast<int>(e));
    }
    for (size_t l = 0; l < lines.size(); ++l) {
      std::ranges::sort(edges_[l], {}, [&](int e) {
        const Arrangement::Edge& edge = arrangement.edges[e];
        const Eigen::Vector2d middle =
            (arrangement.vertices[edge.from] + arrangement.vertices[edge.to]) / 2;
        return lines[l].direction.dot(middle);
      });
    }
  }

  struct Found {
    std::vector<int> edges;
    double length = 0;
  };
  Found Find(const std::vector<int>& labels) const {
    constexpr double kShort_m = 0.02;
    Found found;
    for (const std::vector<int>& line : edges_) {
      for (size_t first = 0; first < line.size();) {
        size_t end = first;
        double length = 0;
        for (; end < line.size() && IsWall(line[end], labels); ++end) length += LengthOf(line[end]);
        if (length < kShort_m) {
          found.edges.insert(found.edges.end(), &line[first], &line[first] + (end - first));
          found.length += length;
        }
        first = std::max(end, first + 1);
      }
    }
    return found;
  }

 private:
  bool IsWall(int e, const std::vector<int>& labels) const {
    constexpr double kStep_m = 0.05;
    return std::abs(StepOver(arrangement_, arrangement_.edges[e], roofs_, labels)) > kStep_m;
  }
  double LengthOf(int e) const {
    const Arrangement::Edge& edge = arrangement_.edges[e];
    return (arrangement_.vertices[edge.to] - arrangement_.vertices[edge.from]).norm();
  }

  const Arrangement& arrangement_;
  std::span<const RoofPlane> roofs_;
  std::vector<std::vector<int>> edges_;  // by line, in their order along it
};

}  // namespace

std::vector<Segment2d> InnerWalls(const Arrangement& arrangement, std::span<const CutLine> lines,
                                  int edges, std::span<const RoofPlane> roofs,
                                  const std::vector<int>& labels) {
  std::map<std::pair<int, bool>, Extent> walls;  // by line, and whether they run along it
  for (const Arrangement::Edge& edge : arrangement.edges) {
    if (edge.line < edges || lines[edge.line].crease) continue;
    const Eigen::Vector2d &p = arrangement.vertices[edge.from], &q = arrangement.vertices[edge.to];
    const double step = StepOver(arrangement, edge, roofs, labels);
    if (step == 0) continue;
    const CutLine& line = lines[edge.line];
    const bool along = (line.direction.dot(q - p) > 0) == (step > 0);
    Extent& extent = walls[{edge.line, along}];
    for (const Eigen::Vector2d& end : {p, q}) {
      const double at = line.direction.dot(end - line.point);
      extent.from = std::min(extent.from, at);
      extent.to = std::max(extent.to, at);
    }
  }
  std::vector<Segment2d> segments;
  segments.reserve(walls.size());
  for (const auto& [wall, extent] : walls) {
    const CutLine& line = lines[wall.first];
    const Eigen::Vector2d from = line.point + extent.from * line.direction;
    const Eigen::Vector2d to = line.point + extent.to * line.direction;
    segments.push_back(wall.second ? Segment2d{from, to} : Segment2d{to, from});
  }
  return segments;
}

void DropShortWalls(const Arrangement& arrangement, std::span<const CutLine> lines,
                    std::span<const RoofPlane> roofs, const std::vector<bool>& inside,
                    std::vector<int>& labels) {
  const ShortWalls walls(arrangement, lines, roofs);
  const auto area = [&](int face) { return SignedArea(RingOf(arrangement, face)); };
  ShortWalls::Found found = walls.Find(labels);
  std::vector<bool> is_changed(labels.size(), false);
  for (size_t i = 0; i < found.edges.size();) {
    const Arrangement::Edge& edge = arrangement.edges[found.edges[i++]];
    if (edge.left < 0 || edge.right < 0 || !inside[edge.left] || !inside[edge.right]) continue;
    const bool left_goes = area(edge.left) < area(edge.right);
    const int cell = left_goes ? edge.left : edge.right;
    if (is_changed[cell]) continue;
    const int before = std::exchange(labels[cell], labels[left_goes ? edge.right : edge.left]);
    ShortWalls::Found after = walls.Find(labels);
    // The first half of such a corner is no worse, the second one better.
    if (after.length > found.length * (1 + 1e-6)) {
      labels[cell] = before;
      continue;
    }
    is_changed[cell] = true;  // and never again: this ends
    found = std::move(after);
    i = 0;
  }
}

}  // namespace stucco
