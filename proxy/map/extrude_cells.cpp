// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/extrude_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <map>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace stucco {
namespace {

// Heights nearer than this are one: roofs that meet in a line agree on it to the last digits.
constexpr double kSameHeight = 4e-7;

// A corner of the solid: a vertex of the arrangement and a height there, by number.
using Corner = std::pair<int, int>;

struct RawFace {
  ExtrudedFace face;
  std::vector<Corner> outer;
  std::vector<std::vector<Corner>> holes;
};

// An upright piece over an edge of the arrangement, what is solid on its left.
struct Piece {
  int from = 0, to = 0;                // vertices
  int bottom_from = 0, bottom_to = 0;  // heights, by number
  int top_from = 0, top_to = 0;
};

class Extruder {
 public:
  Extruder(Arrangement arrangement, std::span<const CutLine> lines, Storeys storeys)
      : plan_(std::move(arrangement)),
        lines_(lines),
        labels_(std::move(storeys.labels)),
        roofs_(storeys.roofs),
        floors_(std::move(storeys.floors)) {
    floors_.resize(labels_.size(), storeys.ground);
  }

  std::vector<ExtrudedFace> Run() {
    SplitCrossings();
    FindHeights();
    AddRoofs();
    AddFloors();
    AddWalls();
    return Finish();
  }

 private:
  int LabelOf(int face) const { return face < 0 ? -1 : labels_[face]; }
  double HeightOver(int vertex, int label) const {
    return roofs_[label].At(plan_.vertices[vertex]);
  }

  // An edge at whose ends different sides are higher gets a vertex where they are equal.
  void SplitCrossings() {
    const size_t count = plan_.edges.size();
    for (size_t e = 0; e < count; ++e) {
      const Arrangement::Edge edge = plan_.edges[e];
      const int left = LabelOf(edge.left), right = LabelOf(edge.right);
      if (left < 0 || right < 0 || left == right) continue;
      const double a = HeightOver(edge.from, left) - HeightOver(edge.from, right);
      const double b = HeightOver(edge.to, left) - HeightOver(edge.to, right);
      if (std::min(std::abs(a), std::abs(b)) <= kSameHeight || (a > 0) == (b > 0)) continue;
      const int vertex = static_cast<int>(plan_.vertices.size());
      const Eigen::Vector2d p = plan_.vertices[edge.from], q = plan_.vertices[edge.to];
      plan_.vertices.push_back(p + a / (a - b) * (q - p));
      for (const int f : {edge.left, edge.right}) InsertInto(plan_.faces[f], edge, vertex);
      plan_.edges[e].to = vertex;
      Arrangement::Edge rest = edge;
      rest.from = vertex;
      plan_.edges.push_back(rest);
    }
  }

  static void InsertInto(std::vector<int>& loop, const Arrangement::Edge& edge, int vertex) {
    for (size_t i = 0; i < loop.size(); ++i) {
      const int a = loop[i], b = loop[(i + 1) % loop.size()];
      if ((a == edge.from && b == edge.to) || (a == edge.to && b == edge.from)) {
        loop.insert(loop.begin() + static_cast<std::ptrdiff_t>(i) + 1, vertex);
        return;
      }
    }
  }

  // The heights of corners over each vertex, ascending.
  void FindHeights() {
    heights_.resize(plan_.vertices.size());
    for (size_t f = 0; f < plan_.faces.size(); ++f) {
      if (labels_[f] < 0) continue;
      for (const int v : plan_.faces[f]) {
        heights_[v].push_back(floors_[f]);
        heights_[v].push_back(HeightOver(v, labels_[f]));
      }
    }
    for (std::vector<double>& list : heights_) {
      std::sort(list.begin(), list.end());
      std::vector<double> kept;
      for (const double z : list) {
        if (kept.empty() || z - kept.back() > kSameHeight) kept.push_back(z);
      }
      list = std::move(kept);
    }
  }

  // Of the height over a vertex that is nearest to this.
  int NumberOf(int vertex, double z) const {
    const std::vector<double>& list = heights_[vertex];
    int best = 0;
    for (size_t i = 1; i < list.size(); ++i) {
      if (std::abs(list[i] - z) < std::abs(list[best] - z)) best = static_cast<int>(i);
    }
    return best;
  }

  // What lies over some cells, or under them: the parts of a plane.
  void AddLevel(const std::vector<bool>& inside, const RoofPlane& plane, ExtrudedFace::Kind kind,
                int roof = -1) {
    const bool looks_up = kind == ExtrudedFace::Kind::kRoof;
    for (const IndexPolygon& polygon : UnionOfIndices(plan_, inside)) {
      RawFace raw;
      raw.face.kind = kind;
      raw.face.roof = roof;
      const Eigen::Vector3d up(-plane.slope.x(), -plane.slope.y(), 1);
      const double side = looks_up ? 1 : -1;
      raw.face.offset = side * plane.height / up.norm();
      raw.face.normal = side * up.normalized();
      const auto lifted = [&](std::vector<int> ring) {
        if (!looks_up) std::reverse(ring.begin(), ring.end());
        std::vector<Corner> corners;
        corners.reserve(ring.size());
        for (const int v : ring) corners.emplace_back(v, NumberOf(v, plane.At(plan_.vertices[v])));
        return corners;
      };
      raw.outer = lifted(polygon.outer);
      for (const auto& hole : polygon.holes) raw.holes.push_back(lifted(hole));
      faces_.push_back(std::move(raw));
    }
  }

  void AddRoofs() {
    for (int label = 0; label < static_cast<int>(roofs_.size()); ++label) {
      std::vector<bool> inside(plan_.faces.size());
      for (size_t f = 0; f < inside.size(); ++f) inside[f] = labels_[f] == label;
      AddLevel(inside, roofs_[label], ExtrudedFace::Kind::kRoof, label);
    }
  }

  void AddFloors() {
    std::set<double> heights;
    for (size_t f = 0; f < floors_.size(); ++f) {
      if (labels_[f] >= 0) heights.insert(floors_[f]);
    }
    for (const double height : heights) {
      std::vector<bool> inside(plan_.faces.size());
      for (size_t f = 0; f < inside.size(); ++f) {
        inside[f] = labels_[f] >= 0 && floors_[f] == height;
      }
      const bool hangs = height > *heights.begin();
      AddLevel(inside, {.height = height},
               hangs ? ExtrudedFace::Kind::kUnderside : ExtrudedFace::Kind::kFloor);
    }
  }

  // Pieces of one line, side and storey, by the vertex they begin at.
  enum class Storey { kTop, kBottom };
  using Chain = std::map<int, Piece>;
  using Chains = std::map<std::tuple<int, bool, Storey>, Chain>;

  // Over an edge, what of a cell is solid, by numbers of heights at both of its ends.
  struct Stack {
    int floor_from = 0, floor_to = 0;
    int roof_from = 0, roof_to = 0;
  };
  std::optional<Stack> StackOver(const Arrangement::Edge& edge, int face) const {
    const int label = LabelOf(face);
    if (label < 0) return std::nullopt;
    return Stack{NumberOf(edge.from, floors_[face]), NumberOf(edge.to, floors_[face]),
                 NumberOf(edge.from, HeightOver(edge.from, label)),
                 NumberOf(edge.to, HeightOver(edge.to, label))};
  }

  // The piece between two heights, solid on the left of the edge or on its right.
  void AddPiece(const Arrangement::Edge& edge, bool left, Storey storey, const Piece& piece,
                Chains& chains) const {
    if (piece.bottom_from == piece.top_from && piece.bottom_to == piece.top_to) return;
    assert(edge.line >= 0);
    const Eigen::Vector2d along = plan_.vertices[edge.to] - plan_.vertices[edge.from];
    const bool forwards = along.dot(lines_[edge.line].direction) > 0;
    Chain& chain = chains[{edge.line, forwards == left, storey}];
    if (left) {
      chain[piece.from] = piece;
    } else {
      chain[piece.to] = {piece.to,          piece.from,   piece.bottom_to,
                         piece.bottom_from, piece.top_to, piece.top_from};
    }
  }

  void AddWhole(const Arrangement::Edge& edge, bool left, const Stack& stack,
                Chains& chains) const {
    AddPiece(edge, left, Storey::kTop,
             {edge.from, edge.to, stack.floor_from, stack.floor_to, stack.roof_from, stack.roof_to},
             chains);
  }

  // Where one cell rises above the other, and where one begins below the other.
  void AddSteps(const Arrangement::Edge& edge, const Stack& left, const Stack& right,
                Chains& chains) const {
    const bool left_rises = left.roof_from >= right.roof_from && left.roof_to >= right.roof_to;
    const auto& [high, low] = left_rises ? std::pair(left, right) : std::pair(right, left);
    AddPiece(edge, left_rises, Storey::kTop,
             {edge.from, edge.to, low.roof_from, low.roof_to, high.roof_from, high.roof_to},
             chains);
    const bool left_begins = left.floor_from <= right.floor_from;
    const auto& [deep, hanging] = left_begins ? std::pair(left, right) : std::pair(right, left);
    AddPiece(
        edge, left_begins, Storey::kBottom,
        {edge.from, edge.to, deep.floor_from, deep.floor_to, hanging.floor_from, hanging.floor_to},
        chains);
  }

  Chains FindPieces() const {
    Chains chains;
    for (const Arrangement::Edge& edge : plan_.edges) {
      const auto left = StackOver(edge, edge.left), right = StackOver(edge, edge.right);
      const bool meet = left && right && left->roof_from > right->floor_from &&
                        right->roof_from > left->floor_from;
      if (meet) {
        AddSteps(edge, *left, *right, chains);
        continue;
      }
      if (left) AddWhole(edge, true, *left, chains);
      if (right) AddWhole(edge, false, *right, chains);
    }
    return chains;
  }

  void AddWalls() {
    for (auto& [key, chain] : FindPieces()) {
      const Eigen::Vector2d along =
          lines_[std::get<0>(key)].direction * (std::get<1>(key) ? 1 : -1);
      std::vector<const Piece*> order;
      for (const auto& [from, piece] : chain) order.push_back(&piece);
      std::stable_sort(order.begin(), order.end(), [&](const Piece* a, const Piece* b) {
        return along.dot(plan_.vertices[a->from]) < along.dot(plan_.vertices[b->from]);
      });
      for (size_t first = 0; first < order.size();) {
        size_t last = first + 1;
        while (last < order.size() && GoesOn(*order[last - 1], *order[last])) ++last;
        AddWall({order.begin() + static_cast<std::ptrdiff_t>(first),
                 order.begin() + static_cast<std::ptrdiff_t>(last)},
                along);
        first = last;
      }
    }
  }

  static bool GoesOn(const Piece& piece, const Piece& next) {
    return piece.to == next.from &&
           std::max(piece.bottom_to, next.bottom_from) < std::min(piece.top_to, next.top_from);
  }

  // From height to height over one vertex, the last one left out.
  static void Climb(int vertex, int from, int to, std::vector<Corner>& ring) {
    for (int h = from; h != to; h += from < to ? 1 : -1) ring.emplace_back(vertex, h);
  }

  void AddWall(const std::vector<const Piece*>& pieces, const Eigen::Vector2d& along) {
    RawFace raw;
    raw.face.kind = ExtrudedFace::Kind::kWall;
    raw.face.normal = Eigen::Vector3d(along.y(), -along.x(), 0).normalized();
    const Eigen::Vector2d start = plan_.vertices[pieces.front()->from];
    const Eigen::Vector2d end = plan_.vertices[pieces.back()->to];
    raw.face.foot = {start, end};
    raw.face.offset = raw.face.normal.head<2>().dot((start + end) / 2);
    std::vector<Corner>& ring = raw.outer;
    for (size_t i = 0; i < pieces.size(); ++i) {
      const Piece& piece = *pieces[i];
      if (i > 0) Climb(piece.from, pieces[i - 1]->bottom_to, piece.bottom_from, ring);
      ring.emplace_back(piece.from, piece.bottom_from);
    }
    const Piece& last = *pieces.back();
    Climb(last.to, last.bottom_to, last.top_to, ring);
    for (size_t i = pieces.size(); i-- > 0;) {
      const Piece& piece = *pieces[i];
      if (i + 1 < pieces.size()) Climb(piece.to, pieces[i + 1]->top_from, piece.top_to, ring);
      ring.emplace_back(piece.to, piece.top_to);
    }
    const Piece& first = *pieces.front();
    Climb(first.from, first.top_from, first.bottom_from, ring);
    faces_.push_back(std::move(raw));
  }

  Eigen::Vector3d PositionOf(const Corner& corner) const {
    const Eigen::Vector2d& p = plan_.vertices[corner.first];
    return {p.x(), p.y(), heights_[corner.first][corner.second]};
  }

  // Corners that some ring turns at; the others lie on straight edges of all their rings.
  std::set<Corner> Turns() const {
    constexpr double kStraight = 1e-7;  // sine
    std::set<Corner> turns;
    const auto visit = [&](const std::vector<Corner>& ring) {
      for (size_t i = 0; i < ring.size(); ++i) {
        const Eigen::Vector3d p = PositionOf(ring[i]);
        const Eigen::Vector3d in =
            (p - PositionOf(ring[(i + ring.size() - 1) % ring.size()])).normalized();
        const Eigen::Vector3d out = (PositionOf(ring[(i + 1) % ring.size()]) - p).normalized();
        if (in.cross(out).norm() > kStraight || in.dot(out) < 0) turns.insert(ring[i]);
      }
    };
    for (const RawFace& raw : faces_) {
      visit(raw.outer);
      for (const auto& hole : raw.holes) visit(hole);
    }
    return turns;
  }

  std::vector<ExtrudedFace> Finish() const {
    const std::set<Corner> turns = Turns();
    const auto positions = [&](const std::vector<Corner>& ring) {
      std::vector<Eigen::Vector3d> points;
      for (const Corner& corner : ring) {
        if (turns.contains(corner)) points.push_back(PositionOf(corner));
      }
      return points;
    };
    std::vector<ExtrudedFace> result;
    for (const RawFace& raw : faces_) {
      ExtrudedFace face = raw.face;
      face.outer = positions(raw.outer);
      for (const auto& hole : raw.holes) face.holes.push_back(positions(hole));
      result.push_back(std::move(face));
    }
    return result;
  }

  Arrangement plan_;
  std::span<const CutLine> lines_;
  std::vector<int> labels_;
  std::span<const RoofPlane> roofs_;
  std::vector<double> floors_;
  std::vector<std::vector<double>> heights_;
  std::vector<RawFace> faces_;
};

// The cells around a vertex, in order, with the edges between them: edge i lies before cell i.
struct Fan {
  std::vector<int> cells;  // -1: outside of the box
  std::vector<int> edges;
};

std::vector<Fan> FansOf(const Arrangement& arrangement) {
  std::vector<std::vector<std::pair<double, int>>> leaving(arrangement.vertices.size());
  for (size_t e = 0; e < arrangement.edges.size(); ++e) {
    const auto& edge = arrangement.edges[e];
    const Eigen::Vector2d d = arrangement.vertices[edge.to] - arrangement.vertices[edge.from];
    leaving[edge.from].emplace_back(std::atan2(d.y(), d.x()), static_cast<int>(e));
    leaving[edge.to].emplace_back(std::atan2(-d.y(), -d.x()), static_cast<int>(e));
  }
  std::vector<Fan> fans(leaving.size());
  for (size_t v = 0; v < leaving.size(); ++v) {
    std::sort(leaving[v].begin(), leaving[v].end());
    for (const auto& [angle, e] : leaving[v]) {
      const auto& edge = arrangement.edges[e];
      fans[v].edges.push_back(e);
      fans[v].cells.push_back(edge.from == static_cast<int>(v) ? edge.left : edge.right);
    }
  }
  return fans;
}

// Whether high and low alternate around a vertex more than once, at any height.
bool TouchesInEdge(const Fan& fan, const std::vector<double>& heights) {
  for (const double level : heights) {
    int changes = 0;
    for (size_t i = 0; i < fan.cells.size(); ++i) {
      const bool here = heights[i] > level + kSameHeight;
      const bool next = heights[(i + 1) % heights.size()] > level + kSameHeight;
      changes += here != next;
    }
    if (changes > 2) return true;
  }
  return false;
}

// Place in the fan of the smallest cell that may take the label of the next one; -1: there is none.
template <typename MayTake>
int SmallestThat(const Arrangement& arrangement, const Fan& fan, const MayTake& may_take) {
  int smallest = -1;
  double least = 0;
  for (size_t i = 0; i < fan.cells.size(); ++i) {
    const int cell = fan.cells[i], next = fan.cells[(i + 1) % fan.cells.size()];
    if (cell < 0 || next < 0 || !may_take(cell, next)) continue;
    const double area = SignedArea(RingOf(arrangement, cell));
    if (smallest >= 0 && area >= least) continue;
    smallest = static_cast<int>(i);
    least = area;
  }
  return smallest;
}

// The same for cells with roofs and neighbours with others; else for open cells of the footprint.
// -1: parts of the footprint itself touch in a point.
int SmallestToJoin(const Arrangement& arrangement, const Fan& fan, const std::vector<bool>& inside,
                   const std::vector<int>& labels) {
  const int roofed = SmallestThat(arrangement, fan, [&](int cell, int next) {
    return labels[cell] >= 0 && labels[next] >= 0 && labels[next] != labels[cell];
  });
  if (roofed >= 0) return roofed;
  return SmallestThat(arrangement, fan, [&](int cell, int next) {
    return labels[cell] < 0 && inside[cell] && labels[next] >= 0;
  });
}

}  // namespace

std::vector<ExtrudedFace> ExtrudeCells(Arrangement arrangement, std::span<const CutLine> lines,
                                       Storeys storeys) {
  assert(storeys.labels.size() == arrangement.faces.size());
  assert(storeys.floors.empty() || storeys.floors.size() == storeys.labels.size());
  return Extruder(std::move(arrangement), lines, std::move(storeys)).Run();
}

void JoinAtCorners(const Arrangement& arrangement, std::span<const RoofPlane> roofs,
                   const std::vector<bool>& inside, std::vector<int>& labels) {
  constexpr int kMostRounds = 20;
  const std::vector<Fan> fans = FansOf(arrangement);
  for (int round = 0; round < kMostRounds; ++round) {
    bool changed = false;
    for (size_t v = 0; v < fans.size(); ++v) {
      const Fan& fan = fans[v];
      std::vector<double> heights;
      for (const int cell : fan.cells) {
        const int label = cell < 0 ? -1 : labels[cell];
        heights.push_back(label < 0 ? -1e9 : roofs[label].At(arrangement.vertices[v]));
      }
      if (!TouchesInEdge(fan, heights)) continue;
      const int smallest = SmallestToJoin(arrangement, fan, inside, labels);
      if (smallest < 0) continue;
      labels[fan.cells[smallest]] =
          labels[fan.cells[(smallest + 1) % static_cast<int>(fan.cells.size())]];
      changed = true;
    }
    if (!changed) return;
  }
}

}  // namespace stucco
