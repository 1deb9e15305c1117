// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/neighbours.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <span>
#include <utility>

#include "proxy/map/move_edges.h"
#include "proxy/map/shared_length.h"
#include "proxy/map/wall_among.h"

namespace stucco {
namespace {

// The edge of a neighbour that one runs against.
struct Opposite {
  double shared = 0;  // metres
  double gap = 0;     // to it, outwards; negative: they overlap
  bool held = false;
};

class Neighbourhood {
 public:
  Neighbourhood(const UprightSurvey& survey, double map_sigma_m,
                const std::vector<FittedBuilding>& buildings)
      : survey_(survey), buildings_(buildings), widest_gap_(2.5 * std::sqrt(2.0) * map_sigma_m) {
    for (const FittedBuilding& building : buildings) {
      boxes_.push_back(BoundsOf(building.building, 0));
    }
  }

  // How far outwards the edges of a building go to meet others.
  std::vector<double> OffsetsOf(size_t b) const {
    constexpr double kLeast_m = 1e-3;
    constexpr double kOfEdge = 0.5;
    std::vector<double> offsets;
    for (const FittedEdge& edge : buildings_[b].edges) {
      double& offset = offsets.emplace_back(0);
      if (edge.fitted) continue;
      const auto opposite = OppositeOf(edge.line, b);
      if (!opposite || opposite->shared < kOfEdge * (edge.line.b - edge.line.a).norm()) continue;
      const double way = opposite->held ? opposite->gap : opposite->gap / 2;
      const bool is_alley = opposite->gap > 0 && (opposite->gap > widest_gap_ ||
                                                  ShowsGround(edge.line, opposite->gap, b));
      if (std::abs(way) > kLeast_m && !is_alley) offset = way;
    }
    return offsets;
  }

 private:
  // The one that shares most; an edge that points hold counts twice.
  std::optional<Opposite> OppositeOf(const Segment2d& edge, size_t b) const {
    std::optional<Opposite> best;
    const Eigen::Vector2d outwards = OutwardsOf(edge), middle = (edge.a + edge.b) / 2;
    const Eigen::AlignedBox2d box = Around(edge);
    const auto weight = [](double shared, bool held) { return shared * (held ? 2 : 1); };
    for (size_t o = 0; o < buildings_.size(); ++o) {
      if (o == b || !box.intersects(boxes_[o])) continue;
      for (const auto& other : buildings_[o].edges) {
        const double shared = SharedLength(edge, other.line, kMapReach_m, Heading::kOpposite);
        if (!(shared > 0)) continue;
        if (best && weight(shared, other.fitted) <= weight(best->shared, best->held)) continue;
        const Eigen::Vector2d along = (other.line.b - other.line.a).normalized();
        const Eigen::Vector2d across = other.line.a + along * along.dot(middle - other.line.a);
        best = {shared, outwards.dot(across - middle), other.fitted};
      }
    }
    return best;
  }

  bool ShowsGround(const Segment2d& edge, double gap, size_t b) const {
    constexpr double kCovered = 0.2;
    constexpr double kNearGround_m = 0.5;
    const Eigen::Vector2d outwards = OutwardsOf(edge), along(-outwards.y(), outwards.x());
    const double length = (edge.b - edge.a).norm();
    double samples = 0;
    for (const int i : survey_.bins.In(Around(edge))) {
      const Eigen::Vector3d& p = survey_.samples.positions[i];
      const double off = outwards.dot(p.head<2>() - edge.a), at = along.dot(p.head<2>() - edge.a);
      const bool between = off > 0 && off < gap && at > 0 && at < length;
      if (between && p.z() < buildings_[b].ground + kNearGround_m) ++samples;
    }
    return samples * survey_.tolerances.spacing * survey_.tolerances.spacing >
           kCovered * gap * length;
  }

  static Eigen::AlignedBox2d Around(const Segment2d& edge) {
    Eigen::AlignedBox2d box(edge.a);
    box.extend(edge.b);
    box.min().array() -= kMapReach_m;
    box.max().array() += kMapReach_m;
    return box;
  }

  const UprightSurvey& survey_;
  const std::vector<FittedBuilding>& buildings_;
  double widest_gap_;
  std::vector<Eigen::AlignedBox2d> boxes_;
};

// Stays as it is where its outline would cross itself.
void MoveEdges(std::span<const double> offsets, FittedBuilding& building) {
  std::vector<Polygon> moved;
  size_t first = 0;
  for (const Polygon& part : building.building.parts) {
    size_t edges = 0;
    for (const Ring& ring : part.rings) edges += ring.size();
    std::vector<EdgeMove> moves;
    moves.reserve(edges);
    for (const double offset : offsets.subspan(first, edges)) moves.push_back({offset, offset});
    auto polygon = WithEdgesMoved(part, moves);
    if (!polygon) return;
    moved.push_back(std::move(*polygon));
    first += edges;
  }
  building = WithParts(std::move(building), std::move(moved));
}

}  // namespace

void MeetNeighbours(const UprightSurvey& survey, double map_sigma_m,
                    std::vector<FittedBuilding>& buildings) {
  constexpr int kRounds = 3;  // what goes half way comes closer each time
  for (int round = 0; round < kRounds; ++round) {
    const Neighbourhood before(survey, map_sigma_m, buildings);
    std::vector<std::vector<double>> offsets;
    for (size_t b = 0; b < buildings.size(); ++b) offsets.push_back(before.OffsetsOf(b));
    for (size_t b = 0; b < buildings.size(); ++b) {
      const bool moves = std::ranges::any_of(offsets[b], [](double offset) { return offset != 0; });
      if (moves) MoveEdges(offsets[b], buildings[b]);
    }
  }
}

}  // namespace stucco
