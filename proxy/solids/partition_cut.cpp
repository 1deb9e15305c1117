// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/intersections.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <map>

#include "proxy/solids/partition.h"
#include "survey/error.h"

namespace stucco {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using EdgeKey = std::pair<int, int>;

EdgeKey KeyOf(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

// Cuts cells by exact planes and keeps the complex conforming: an edge is cut once for all of its
// faces, a face once for both of its cells.
class CellCutter {
 public:
  CellCutter(const Eigen::AlignedBox3d& box, Partition& partition) : out_(partition) {
    for (int axis = 0; axis < 3; ++axis) {
      AddPlane({Eigen::Vector3d::Unit(axis), box.min()[axis]});
      AddPlane({Eigen::Vector3d::Unit(axis), box.max()[axis]});
    }
    MakeBox();
  }

  void Cut(const CutPlane& plane) {
    AddPlane(plane);
    plane_ = static_cast<int>(planes_.size()) - 1;
    sides_.assign(points_.size(), kNotKnown);
    const size_t count = out_.cells.size();
    for (size_t c = 0; c < count; ++c) CutCell(static_cast<int>(c));
  }

  void Finish() {
    out_.vertices.reserve(points_.size());
    for (const auto& p : points_) {
      out_.vertices.emplace_back(CGAL::to_double(p.x()), CGAL::to_double(p.y()),
                                 CGAL::to_double(p.z()));
    }
  }

 private:
  static constexpr int kNotKnown = 2;
  struct Edge {
    int plane_a = 0, plane_b = 0;  // the edge lies on both
    std::vector<int> faces;
  };

  void AddPlane(const CutPlane& plane) {
    out_.planes.push_back(plane);
    planes_.emplace_back(plane.normal.x(), plane.normal.y(), plane.normal.z(), -plane.offset);
  }

  ExactKernel::Point_3 Meet(int a, int b, int c) const {
    const auto result = CGAL::intersection(planes_[a], planes_[b], planes_[c]);
    const auto* point = result ? boost::get<ExactKernel::Point_3>(&*result) : nullptr;
    if (point == nullptr) throw Fault("three planes of a vertex do not meet");
    return *point;
  }

  void MakeBox() {
    // Vertex xyz has bit 0, 1, 2 set for the high x, y, z.
    for (int v = 0; v < 8; ++v) {
      points_.push_back(Meet(v & 1, 2 + (v >> 1 & 1), 4 + (v >> 2 & 1)));
    }
    // Loops counter-clockwise seen from the positive axis.
    const std::array<std::array<int, 4>, 6> loops = {
        {{0, 2, 6, 4}, {1, 3, 7, 5}, {0, 4, 5, 1}, {2, 6, 7, 3}, {0, 1, 3, 2}, {4, 5, 7, 6}}};
    out_.cells.emplace_back();
    for (int f = 0; f < 6; ++f) {
      const bool high = f % 2 == 1;
      out_.faces.push_back({.loop = {loops[f].begin(), loops[f].end()},
                            .plane = f,
                            .below = high ? 0 : -1,
                            .above = high ? -1 : 0});
      out_.cells[0].push_back(f);
    }
    for (int f = 0; f < 6; ++f) {
      const auto& loop = out_.faces[f].loop;
      for (size_t i = 0; i < loop.size(); ++i) {
        Edge& edge = edges_[KeyOf(loop[i], loop[(i + 1) % loop.size()])];
        (edge.faces.empty() ? edge.plane_a : edge.plane_b) = f;
        edge.faces.push_back(f);
      }
    }
    out_.tree.push_back({.plane = -1, .above = -1, .below = -1, .cell = 0});
    leaf_of_cell_ = {0};
  }

  int SideOf(int vertex) {
    int& side = sides_[vertex];
    if (side == kNotKnown) side = planes_[plane_].oriented_side(points_[vertex]);
    return side;
  }

  std::pair<bool, bool> SidesOf(const std::vector<int>& loop) {
    bool above = false, below = false;
    for (const int v : loop) {
      above |= SideOf(v) > 0;
      below |= SideOf(v) < 0;
    }
    return {above, below};
  }

  void CutCell(int cell) {
    bool above = false, below = false;
    for (const int f : out_.cells[cell]) {
      const auto [a, b] = SidesOf(out_.faces[f].loop);
      above |= a;
      below |= b;
    }
    if (!above || !below) return;
    CutEdgesOf(cell);
    const std::vector<int> faces = out_.cells[cell];
    for (const int f : faces) {
      const auto [a, b] = SidesOf(out_.faces[f].loop);
      if (a && b) SplitFace(f);
    }
    SplitCell(cell);
  }

  void CutEdgesOf(int cell) {
    std::vector<EdgeKey> crossing;
    for (const int f : out_.cells[cell]) {
      const auto& loop = out_.faces[f].loop;
      for (size_t i = 0; i < loop.size(); ++i) {
        const int a = loop[i], b = loop[(i + 1) % loop.size()];
        if (SideOf(a) * SideOf(b) < 0) crossing.push_back(KeyOf(a, b));
      }
    }
    std::sort(crossing.begin(), crossing.end());
    crossing.erase(std::unique(crossing.begin(), crossing.end()), crossing.end());
    for (const EdgeKey& key : crossing) CutEdge(key);
  }

  void CutEdge(const EdgeKey& key) {
    const auto node = edges_.extract(key);
    const Edge& edge = node.mapped();
    const int vertex = static_cast<int>(points_.size());
    points_.push_back(Meet(edge.plane_a, edge.plane_b, plane_));
    sides_.push_back(0);
    for (const int f : edge.faces) {
      auto& loop = out_.faces[f].loop;
      for (size_t i = 0; i < loop.size(); ++i) {
        if (KeyOf(loop[i], loop[(i + 1) % loop.size()]) != key) continue;
        loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, vertex);
        break;
      }
    }
    edges_[KeyOf(key.first, vertex)] = edge;
    edges_[KeyOf(vertex, key.second)] = edge;
  }

  // The part above the plane stays in face f, the part below becomes a new face.
  void SplitFace(int f) {
    const std::vector<int> loop = out_.faces[f].loop;
    std::vector<size_t> on;
    for (size_t i = 0; i < loop.size(); ++i) {
      if (SideOf(loop[i]) == 0) on.push_back(i);
    }
    if (on.size() != 2) throw Fault("a face meets a plane in more than two points");
    std::vector<int> first(loop.begin() + static_cast<std::ptrdiff_t>(on[0]),
                           loop.begin() + static_cast<std::ptrdiff_t>(on[1]) + 1);
    std::vector<int> second(loop.begin() + static_cast<std::ptrdiff_t>(on[1]), loop.end());
    second.insert(second.end(), loop.begin(),
                  loop.begin() + static_cast<std::ptrdiff_t>(on[0]) + 1);
    if (SideOf(first[1]) < 0) std::swap(first, second);
    const int g = static_cast<int>(out_.faces.size());
    Partition::Face lower = out_.faces[f];
    lower.loop = second;
    for (size_t i = 0; i + 1 < second.size(); ++i) {
      auto& faces = edges_.at(KeyOf(second[i], second[i + 1])).faces;
      std::replace(faces.begin(), faces.end(), f, g);
    }
    edges_[KeyOf(loop[on[0]], loop[on[1]])] = {lower.plane, plane_, {f, g}};
    for (const int cell : {lower.below, lower.above}) {
      if (cell >= 0) out_.cells[cell].push_back(g);
    }
    out_.faces[f].loop = std::move(first);
    out_.faces.push_back(std::move(lower));
  }

  // All faces of the cell lie on one side by now: parts them and closes both with the section.
  void SplitCell(int cell) {
    const int lower_cell = static_cast<int>(out_.cells.size());
    const int section = static_cast<int>(out_.faces.size());
    std::vector<int> upper, lower;
    std::map<int, int> next;  // along the section, counter-clockwise seen from above
    for (const int f : out_.cells[cell]) {
      Partition::Face& face = out_.faces[f];
      if (!SidesOf(face.loop).first) {
        (face.below == cell ? face.below : face.above) = lower_cell;
        lower.push_back(f);
        continue;
      }
      upper.push_back(f);
      for (size_t i = 0; i < face.loop.size(); ++i) {
        const int a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
        if (SideOf(a) != 0 || SideOf(b) != 0) continue;
        // Seen from outside of the cell the loop runs on when the cell is below the face.
        if (face.below == cell) {
          next[a] = b;
        } else {
          next[b] = a;
        }
      }
    }
    if (next.size() < 3) throw Fault("a plane cuts a cell in less than a polygon");
    Partition::Face face{.loop = {}, .plane = plane_, .below = lower_cell, .above = cell};
    int vertex = next.begin()->first;
    for (size_t i = 0; i < next.size(); ++i) {
      face.loop.push_back(vertex);
      const auto step = next.find(vertex);
      if (step == next.end()) throw Fault("the section of a cell is not closed");
      edges_.at(KeyOf(vertex, step->second)).faces.push_back(section);
      vertex = step->second;
    }
    out_.faces.push_back(std::move(face));
    upper.push_back(section);
    lower.push_back(section);
    out_.cells[cell] = std::move(upper);
    out_.cells.push_back(std::move(lower));
    GrowTree(cell, lower_cell);
  }

  void GrowTree(int cell, int lower_cell) {
    const int node = leaf_of_cell_[cell];
    const int above = static_cast<int>(out_.tree.size());
    out_.tree.push_back({.plane = -1, .above = -1, .below = -1, .cell = cell});
    out_.tree.push_back({.plane = -1, .above = -1, .below = -1, .cell = lower_cell});
    out_.tree[node] = {.plane = plane_, .above = above, .below = above + 1, .cell = -1};
    leaf_of_cell_[cell] = above;
    leaf_of_cell_.push_back(above + 1);
  }

  static Error Fault(const std::string& what) {
    return Error(ErrorKind::kStageFailed, "partition of a building: " + what);
  }

  Partition& out_;
  int plane_ = 0;
  std::vector<ExactKernel::Plane_3> planes_;
  std::vector<ExactKernel::Point_3> points_;
  std::vector<int> sides_;
  std::map<EdgeKey, Edge> edges_;
  std::vector<int> leaf_of_cell_;
};

}  // namespace

Partition PartitionBox(const Eigen::AlignedBox3d& box, std::span<const CutPlane> planes,
                       size_t most_cells) {
  Partition partition;
  CellCutter cutter(box, partition);
  for (const CutPlane& plane : planes) {
    if (partition.cells.size() >= most_cells) break;
    cutter.Cut(plane);
  }
  cutter.Finish();
  return partition;
}

}  // namespace stucco
