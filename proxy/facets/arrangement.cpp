// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/arrangement.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "survey/disjoint_sets.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

using EdgeKey = std::pair<int, int>;

EdgeKey KeyOf(int a, int b) {
  return {std::min(a, b), std::max(a, b)};
}

// Cuts the faces by one line after the other; all faces share one table of vertices, so that an
// edge is cut at the same vertex on both of its sides.
class Cutter {
 public:
  explicit Cutter(const Eigen::AlignedBox2d& box)
      : tolerance_(1e-9 * std::max(box.sizes().maxCoeff(), 1e-300)) {
    vertices_ = {
        box.min(), {box.max().x(), box.min().y()}, box.max(), {box.min().x(), box.max().y()}};
    faces_ = {{0, 1, 2, 3}};
  }

  void Cut(const CutLine& line, int id) {
    sides_.resize(vertices_.size());
    for (size_t i = 0; i < vertices_.size(); ++i) {
      const double d = Cross(line.direction, vertices_[i] - line.point);
      sides_[i] = std::abs(d) <= tolerance_ ? 0 : d > 0 ? 1 : -1;
    }
    cuts_.clear();
    for (auto& face : faces_) InsertCuts(line, face);
    const size_t count = faces_.size();
    for (size_t f = 0; f < count; ++f) Split(f, id);
  }

  Arrangement Take() {
    Arrangement result;
    std::map<EdgeKey, Arrangement::Edge> edges;
    for (size_t f = 0; f < faces_.size(); ++f) {
      const auto& face = faces_[f];
      for (size_t i = 0; i < face.size(); ++i) {
        const int from = face[i], to = face[(i + 1) % face.size()];
        const EdgeKey key = KeyOf(from, to);
        Arrangement::Edge& edge = edges[key];
        edge.from = key.first;
        edge.to = key.second;
        (from < to ? edge.left : edge.right) = static_cast<int>(f);
        const auto line = line_of_edge_.find(key);
        edge.line = line == line_of_edge_.end() ? -1 : line->second;
      }
    }
    for (const auto& [key, edge] : edges) result.edges.push_back(edge);
    result.vertices = std::move(vertices_);
    result.faces = std::move(faces_);
    return result;
  }

 private:
  void InsertCuts(const CutLine& line, std::vector<int>& face) {
    std::vector<int> loop;
    for (size_t i = 0; i < face.size(); ++i) {
      const int a = face[i], b = face[(i + 1) % face.size()];
      loop.push_back(a);
      if (sides_[a] * sides_[b] < 0) loop.push_back(CutEdge(line, a, b));
    }
    face = std::move(loop);
  }

  int CutEdge(const CutLine& line, int a, int b) {
    const EdgeKey key = KeyOf(a, b);
    if (const auto found = cuts_.find(key); found != cuts_.end()) return found->second;
    const Eigen::Vector2d p = vertices_[key.first], q = vertices_[key.second];
    const double dp = Cross(line.direction, p - line.point);
    const double dq = Cross(line.direction, q - line.point);
    const int vertex = static_cast<int>(vertices_.size());
    vertices_.push_back(p + dp / (dp - dq) * (q - p));
    sides_.push_back(0);
    cuts_[key] = vertex;
    if (const auto found = line_of_edge_.find(key); found != line_of_edge_.end()) {
      line_of_edge_[KeyOf(a, vertex)] = found->second;
      line_of_edge_[KeyOf(vertex, b)] = found->second;
    }
    return vertex;
  }

  void Split(size_t f, int id) {
    const std::vector<int> face = faces_[f];
    bool left = false, right = false;
    for (const int v : face) {
      left |= sides_[v] > 0;
      right |= sides_[v] < 0;
    }
    if (!left || !right) return;
    std::vector<int> kept, cut, on;
    for (const int v : face) {
      if (sides_[v] >= 0) kept.push_back(v);
      if (sides_[v] <= 0) cut.push_back(v);
      if (sides_[v] == 0) on.push_back(v);
    }
    if (kept.size() < 3 || cut.size() < 3 || on.size() != 2) return;
    line_of_edge_[KeyOf(on[0], on[1])] = id;
    faces_[f] = std::move(kept);
    faces_.push_back(std::move(cut));
  }

  double tolerance_;
  std::vector<Eigen::Vector2d> vertices_;
  std::vector<std::vector<int>> faces_;
  std::vector<int> sides_;
  std::map<EdgeKey, int> cuts_;
  std::map<EdgeKey, int> line_of_edge_;
};

// Boundary of the union as directed edges, the inside on the left.
struct Border {
  int from, to, component;
};

// The next border edge at a vertex: the one that turns left most, so that rings that touch in a
// vertex stay apart.
int NextBorder(const Arrangement& arrangement, const std::vector<Border>& borders,
               const std::vector<int>& leaving, const std::vector<bool>& used, int current) {
  const auto direction = [&](const Border& border) {
    return Eigen::Vector2d(arrangement.vertices[border.to] - arrangement.vertices[border.from]);
  };
  const Eigen::Vector2d in = direction(borders[current]);
  int best = -1;
  double best_turn = -std::numeric_limits<double>::infinity();
  for (const int candidate : leaving) {
    if (used[candidate] || borders[candidate].component != borders[current].component) continue;
    const Eigen::Vector2d out = direction(borders[candidate]);
    const double turn = std::atan2(Cross(in, out), in.dot(out));
    if (turn > best_turn) {
      best_turn = turn;
      best = candidate;
    }
  }
  return best;
}

std::vector<Eigen::Vector2d> WithoutStraightCorners(const std::vector<Eigen::Vector2d>& ring) {
  constexpr double kStraight = 1e-7;  // sine of the turn
  std::vector<Eigen::Vector2d> kept;
  for (size_t i = 0; i < ring.size(); ++i) {
    const Eigen::Vector2d in = (ring[i] - ring[(i + ring.size() - 1) % ring.size()]).normalized();
    const Eigen::Vector2d out = (ring[(i + 1) % ring.size()] - ring[i]).normalized();
    if (std::abs(Cross(in, out)) > kStraight || in.dot(out) < 0) kept.push_back(ring[i]);
  }
  return kept;
}

struct Traced {
  std::vector<int> vertices;
  int component;
};

std::vector<Traced> TraceRings(const Arrangement& arrangement, const std::vector<Border>& borders) {
  std::vector<std::vector<int>> leaving(arrangement.vertices.size());
  for (size_t i = 0; i < borders.size(); ++i) leaving[borders[i].from].push_back(int(i));
  std::vector<bool> used(borders.size(), false);
  std::vector<Traced> rings;
  for (size_t first = 0; first < borders.size(); ++first) {
    if (used[first]) continue;
    Traced ring{.vertices = {}, .component = borders[first].component};
    int current = static_cast<int>(first);
    while (current >= 0) {
      used[current] = true;
      ring.vertices.push_back(borders[current].from);
      // Touching rings share this vertex: going on here would join them.
      if (borders[current].to == borders[first].from) break;
      current = NextBorder(arrangement, borders, leaving[borders[current].to], used, current);
    }
    if (current >= 0 && ring.vertices.size() >= 3) rings.push_back(std::move(ring));
  }
  return rings;
}

Ring PointsOf(const Arrangement& arrangement, const std::vector<int>& ring) {
  Ring points;
  points.reserve(ring.size());
  for (const int v : ring) points.push_back(arrangement.vertices[v]);
  return points;
}

}  // namespace

Arrangement Arrange(const Eigen::AlignedBox2d& box, std::span<const CutLine> lines) {
  Cutter cutter(box);
  for (size_t i = 0; i < lines.size(); ++i) cutter.Cut(lines[i], static_cast<int>(i));
  return cutter.Take();
}

Ring RingOf(const Arrangement& arrangement, size_t face) {
  return PointsOf(arrangement, arrangement.faces[face]);
}

Eigen::Vector2d InnerPoint(const Arrangement& arrangement, size_t face) {
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  for (const int v : arrangement.faces[face]) sum += arrangement.vertices[v];
  return sum / static_cast<double>(arrangement.faces[face].size());
}

std::vector<IndexPolygon> UnionOfIndices(const Arrangement& arrangement,
                                         const std::vector<bool>& inside) {
  DisjointSets components(arrangement.faces.size());
  const auto in = [&](int face) { return face >= 0 && inside[face]; };
  for (const auto& edge : arrangement.edges) {
    if (in(edge.left) && in(edge.right)) components.Join(edge.left, edge.right);
  }
  std::vector<Border> borders;
  for (const auto& edge : arrangement.edges) {
    if (in(edge.left) == in(edge.right)) continue;
    if (in(edge.left)) {
      borders.push_back({edge.from, edge.to, components.Find(edge.left)});
    } else {
      borders.push_back({edge.to, edge.from, components.Find(edge.right)});
    }
  }
  std::vector<Traced> holes;
  std::map<int, std::vector<IndexPolygon>> outers;
  for (Traced& ring : TraceRings(arrangement, borders)) {
    if (SignedArea(PointsOf(arrangement, ring.vertices)) > 0) {
      outers[ring.component].push_back({.outer = std::move(ring.vertices), .holes = {}});
    } else {
      holes.push_back(std::move(ring));
    }
  }
  for (Traced& hole : holes) {
    auto& candidates = outers[hole.component];
    const Eigen::Vector2d middle =
        (arrangement.vertices[hole.vertices[0]] + arrangement.vertices[hole.vertices[1]]) / 2;
    for (IndexPolygon& polygon : candidates) {
      if (candidates.size() > 1 && !Contains(PointsOf(arrangement, polygon.outer), middle)) {
        continue;
      }
      polygon.holes.push_back(std::move(hole.vertices));
      break;
    }
  }
  std::vector<IndexPolygon> result;
  for (auto& [component, list] : outers) {
    for (IndexPolygon& polygon : list) result.push_back(std::move(polygon));
  }
  return result;
}

std::vector<Polygon> UnionOf(const Arrangement& arrangement, const std::vector<bool>& inside) {
  std::vector<Polygon> result;
  for (const IndexPolygon& indices : UnionOfIndices(arrangement, inside)) {
    Ring outer = WithoutStraightCorners(PointsOf(arrangement, indices.outer));
    if (outer.size() < 3) continue;
    Polygon& polygon = result.emplace_back();
    polygon.rings.push_back(std::move(outer));
    for (const auto& hole : indices.holes) {
      Ring ring = WithoutStraightCorners(PointsOf(arrangement, hole));
      if (ring.size() >= 3) polygon.rings.push_back(std::move(ring));
    }
  }
  return result;
}

}  // namespace stucco
