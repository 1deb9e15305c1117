// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/flat_pieces.h"

#include <Eigen/Cholesky>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>
#include <set>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Edge = std::pair<int, int>;

const double kLeastCosine = std::cos(5 * std::numbers::pi / 180);

template <typename Do>
void ForEdges(const std::vector<std::vector<int>>& rings, const Do& what) {
  for (const std::vector<int>& ring : rings) {
    for (size_t i = 0; i < ring.size(); ++i) what(Edge(ring[i], ring[(i + 1) % ring.size()]));
  }
}

Vector3d AreaVectorOf(const WeldedModel& model, const WeldedPolygon& polygon) {
  Vector3d sum = Vector3d::Zero();
  for (const std::vector<int>& ring : polygon.rings) sum += AreaVector(model.corners, ring);
  return sum;
}

// Its plane through the mean of its corners, along its area.
void LayPlane(const WeldedModel& model, FlatPiece& piece) {
  Vector3d area = Vector3d::Zero();
  Vector3d sum = Vector3d::Zero();
  size_t count = 0;
  for (const std::vector<int>& ring : piece.rings) {
    area += AreaVector(model.corners, ring);
    for (const int corner : ring) sum += model.corners[corner];
    count += ring.size();
  }
  piece.normal = area.normalized();
  piece.area = area.norm() / 2;
  piece.offset = piece.normal.dot(sum) / static_cast<double>(count);
  piece.deviation = 0;
  for (const std::vector<int>& ring : piece.rings) {
    for (const int corner : ring) {
      piece.deviation = std::max(piece.deviation,
                                 std::abs(piece.normal.dot(model.corners[corner]) - piece.offset));
    }
  }
}

// The outlines of polygons in a plane.
class Outline {
 public:
  Outline(const WeldedModel& model, const Vector3d& normal) : model_(model) {
    u_ = normal.unitOrthogonal();
    v_ = normal.cross(u_);
  }

  void Add(const WeldedPolygon& polygon) {
    ForEdges(polygon.rings, [&](const Edge& edge) {
      const auto back = edges_.find({edge.second, edge.first});
      if (back != edges_.end()) {
        edges_.erase(back);
      } else {
        edges_.insert(edge);
      }
    });
  }

  // Each an outer ring with its holes.
  std::vector<std::vector<std::vector<int>>> Take() {
    std::vector<std::vector<std::vector<int>>> outer;
    std::vector<std::vector<int>> holes;
    while (!edges_.empty()) {
      for (std::vector<int>& ring : Simple(TakeRing())) {
        const double area = SignedArea(InPlane(ring));
        if (area > 0) {
          outer.push_back({std::move(ring)});
        } else if (area < 0) {
          holes.push_back(std::move(ring));
        }
      }
    }
    for (std::vector<int>& hole : holes) {
      const Vector2d inside = (At(hole[0]) + At(hole[1])) / 2;
      const auto around = std::ranges::find_if(
          outer, [&](const auto& rings) { return Contains(InPlane(rings.front()), inside); });
      if (around != outer.end()) around->push_back(std::move(hole));
    }
    return outer;
  }

 private:
  Vector2d At(int corner) const {
    const Vector3d& p = model_.corners[corner];
    return {u_.dot(p), v_.dot(p)};
  }
  Ring InPlane(const std::vector<int>& ring) const {
    Ring out;
    out.reserve(ring.size());
    for (const int corner : ring) out.push_back(At(corner));
    return out;
  }

  // Rings that pass no corner twice.
  static std::vector<std::vector<int>> Simple(const std::vector<int>& ring) {
    std::vector<std::vector<int>> out;
    std::vector<int> open;
    for (const int corner : ring) {
      const auto before = std::ranges::find(open, corner);
      if (before != open.end()) {
        out.emplace_back(before, open.end());
        open.erase(before, open.end());
      }
      open.push_back(corner);
    }
    out.push_back(std::move(open));
    return out;
  }

  // Follows edges with the inside on the left; where outlines touch at a corner, along the same
  // part of the inside.
  std::vector<int> TakeRing() {
    const Edge first = *edges_.begin();
    edges_.erase(edges_.begin());
    std::vector<int> ring = {first.first};
    Edge at = first;
    while (at.second != first.first) {
      const auto next = NextAfter(at);
      if (next == edges_.end()) return {};  // its edges were shared by three
      at = *next;
      edges_.erase(next);
      ring.push_back(at.first);
    }
    return ring;
  }

  std::multiset<Edge>::iterator NextAfter(const Edge& edge) {
    const Vector2d back = At(edge.first) - At(edge.second);
    auto best = edges_.end();
    double least = 0;
    for (auto at = edges_.lower_bound({edge.second, -1});
         at != edges_.end() && at->first == edge.second; ++at) {
      const Vector2d way = At(at->second) - At(at->first);
      double clockwise = -std::atan2(Cross(back, way), back.dot(way));
      if (clockwise <= 0) clockwise += 2 * std::numbers::pi;
      if (best != edges_.end() && clockwise >= least) continue;
      best = at;
      least = clockwise;
    }
    return best;
  }

  const WeldedModel& model_;
  Vector3d u_, v_;
  std::multiset<Edge> edges_;
};

class PieceFinder {
 public:
  PieceFinder(const WeldedModel& model, double flat) : model_(model), flat_(flat) {
    for (size_t i = 0; i < model.polygons.size(); ++i) {
      ForEdges(model.polygons[i].rings,
               [&](const Edge& edge) { users_[edge].push_back(static_cast<int>(i)); });
      areas_.push_back(AreaVectorOf(model, model.polygons[i]));
    }
    taken_.resize(model.polygons.size());
  }

  std::vector<FlatPiece> Find() {
    std::vector<int> order(model_.polygons.size());
    std::iota(order.begin(), order.end(), 0);
    std::ranges::stable_sort(order, std::greater<>(), [&](int i) { return areas_[i].norm(); });
    for (const int seed : order) {
      if (!taken_[seed]) AddPieces(GrownFrom(seed));
    }
    std::ranges::stable_sort(pieces_, {}, &FlatPiece::first);
    return std::move(pieces_);
  }

 private:
  std::vector<int> GrownFrom(int seed) {
    const Vector3d normal = areas_[seed].normalized();
    const double offset = normal.dot(model_.corners[model_.polygons[seed].rings.front().front()]);
    std::vector<int> members = {seed};
    taken_[seed] = 1;
    for (size_t i = 0; i < members.size(); ++i) {
      const int at = members[i];
      ForEdges(model_.polygons[at].rings, [&](const Edge& edge) {
        const int next = OtherSide(edge);
        if (next < 0 || taken_[next] || !Joins(next, seed, normal, offset)) return;
        taken_[next] = 1;
        members.push_back(next);
      });
    }
    return members;
  }

  // The polygon beyond an edge that two polygons share, wound alike; -1: none.
  int OtherSide(const Edge& edge) const {
    const auto back = users_.find({edge.second, edge.first});
    if (back == users_.end() || back->second.size() != 1) return -1;
    return users_.at(edge).size() == 1 ? back->second.front() : -1;
  }

  bool Joins(int polygon, int seed, const Vector3d& normal, double offset) const {
    const WeldedPolygon& candidate = model_.polygons[polygon];
    const WeldedPolygon& first = model_.polygons[seed];
    if (candidate.object != first.object || candidate.group != first.group ||
        areas_[polygon].normalized().dot(normal) < kLeastCosine) {
      return false;
    }
    return std::ranges::all_of(candidate.rings.front(), [&](int corner) {
      return std::abs(normal.dot(model_.corners[corner]) - offset) <= flat_;
    });
  }

  void AddPieces(const std::vector<int>& members) {
    const WeldedPolygon& first = model_.polygons[members.front()];
    Vector3d area = Vector3d::Zero();
    for (const int member : members) area += areas_[member];
    Outline outline(model_, area.normalized());
    for (const int member : members) outline.Add(model_.polygons[member]);
    for (auto& rings : outline.Take()) {
      FlatPiece& piece = pieces_.emplace_back();
      piece.rings = std::move(rings);
      piece.object = first.object;
      piece.first = *std::ranges::min_element(members);
      piece.facet_class = first.facet_class;
      piece.id = first.id;
      LayPlane(model_, piece);
    }
  }

  const WeldedModel& model_;
  double flat_;
  PieceEdges users_;             // polygons by edge
  std::vector<Vector3d> areas_;  // twice
  std::vector<char> taken_;
  std::vector<FlatPiece> pieces_;
};

}  // namespace

PieceEdges EdgesOf(const std::vector<FlatPiece>& pieces) {
  PieceEdges edges;
  for (size_t i = 0; i < pieces.size(); ++i) {
    ForEdges(pieces[i].rings,
             [&](const Edge& edge) { edges[edge].push_back(static_cast<int>(i)); });
  }
  return edges;
}

void Settle(double most, WeldedModel& model, std::vector<FlatPiece>& pieces) {
  constexpr int kMostRounds = 300;
  constexpr double kSettled = 1e-7;
  constexpr double kStay = 1e-4;  // weight of where a corner was, beside that of a plane
  const std::vector<Vector3d> before = model.corners;
  std::vector<std::set<int>> pieces_of(before.size());
  for (size_t i = 0; i < pieces.size(); ++i) {
    ForEdges(pieces[i].rings,
             [&](const Edge& edge) { pieces_of[edge.first].insert(static_cast<int>(i)); });
  }
  const auto is_settled = [&] {
    return std::ranges::all_of(pieces,
                               [&](const FlatPiece& piece) { return piece.deviation <= kSettled; });
  };
  for (int round = 0; round < kMostRounds && !is_settled(); ++round) {
    for (size_t corner = 0; corner < before.size(); ++corner) {
      Vector3d& p = model.corners[corner];
      Eigen::Matrix3d matrix = kStay * Eigen::Matrix3d::Identity();
      Vector3d right = Vector3d::Zero();
      for (const int i : pieces_of[corner]) {
        matrix += pieces[i].normal * pieces[i].normal.transpose();
        right += (pieces[i].offset - pieces[i].normal.dot(p)) * pieces[i].normal;
      }
      const Vector3d moved = p + matrix.ldlt().solve(right);
      if ((moved - before[corner]).norm() <= most) p = moved;
    }
    for (FlatPiece& piece : pieces) LayPlane(model, piece);
  }
}

std::vector<FlatPiece> FindFlatPieces(const WeldedModel& model, double flat) {
  return PieceFinder(model, flat).Find();
}

}  // namespace stucco
