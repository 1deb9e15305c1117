// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facades.h"

#include <fmt/format.h>

#include <algorithm>
#include <map>

#include "site/box_grid.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

// Shorter or lower pieces are leftovers of imprecise maps, not walls to photograph.
constexpr double kLeastLength_m = 0.1;
constexpr double kLeastHeight_m = 0.5;
constexpr double kLeastUpperWall_m = 1;  // of what a lower part leaves free
// Size of the cells in which neighbours are looked for: about a long wall.
constexpr double kCell_m = 20;

struct Edge {
  int footprint = 0;
  int wall = 0;  // in its building; the edges of a straight wall share it
  Eigen::Vector2d a;
  Eigen::Vector2d b;
};

// Where something stands against an edge.
struct Cover {
  Interval along_m;
  Interval z_m;
  bool by_other_building = false;
};

// Whether the ring goes straight on at a corner, which then only joins a neighbour to the wall.
bool IsStraight(const Eigen::Vector2d& before, const Eigen::Vector2d& corner,
                const Eigen::Vector2d& after) {
  constexpr double kAhead = 0.98;
  return (corner - before).normalized().dot((after - corner).normalized()) > kAhead &&
         Distance(Segment2d{before, after}, corner) <= kSnap_m;
}

std::vector<Edge> EdgesOf(const std::vector<Footprint>& footprints) {
  std::vector<Edge> edges;
  std::map<std::string, int> counts;
  for (size_t f = 0; f < footprints.size(); ++f) {
    int& count = counts[footprints[f].building];
    for (const Ring& ring : footprints[f].outline.rings) {
      const size_t n = ring.size();
      for (size_t i = 0; i < n; ++i) {
        const bool goes_on = i > 0 && IsStraight(ring[i - 1], ring[i], ring[(i + 1) % n]);
        if (!goes_on) ++count;
        edges.push_back({static_cast<int>(f), count - 1, ring[i], ring[(i + 1) % n]});
      }
    }
  }
  return edges;
}

// The part of `edge` along which `other` runs the other way within the tolerance; empty where it
// does not.
Interval Shared(const Edge& edge, const Edge& other) {
  const Eigen::Vector2d u = (edge.b - edge.a).normalized();
  const Eigen::Vector2d v = other.b - other.a;
  constexpr double kOpposite = -0.98;  // walls that meet at more than 11 degrees only touch
  if (!(u.dot(v) < kOpposite * v.norm())) return {};
  const auto offset = [&](const Eigen::Vector2d& p) { return Cross(u, p - edge.a); };
  // Offsets change linearly along `other`: cut it down to |offset| <= tolerance.
  const double start = offset(other.a);
  const double change = offset(other.b) - start;
  double low = 0;
  double high = 1;
  for (const double sign : {1.0, -1.0}) {
    const double room = kSnap_m - sign * start;
    if (sign * change > 0) high = std::min(high, room / (sign * change));
    if (sign * change < 0) low = std::max(low, room / (sign * change));
    if (change == 0 && room < 0) return {};
  }
  if (!(low < high)) return {};
  const double length = (edge.b - edge.a).norm();
  const double from = std::max(0.0, u.dot(other.a + high * v - edge.a));
  const double to = std::min(length, u.dot(other.a + low * v - edge.a));
  return from < to ? Interval{from, to} : Interval{};
}

bool Overlap(const Interval& a, const Interval& b) {
  return a.from_m < b.to_m && b.from_m < a.to_m;
}

std::vector<Cover> CoversOf(const Edge& edge, const std::vector<int>& near,
                            const std::vector<Edge>& edges,
                            const std::vector<Footprint>& footprints) {
  const Footprint& own = footprints[edge.footprint];
  std::vector<Cover> covers;
  for (const int index : near) {
    const Edge& other = edges[index];
    if (other.footprint == edge.footprint) continue;
    const Footprint& neighbour = footprints[other.footprint];
    if (neighbour.is_obstacle) continue;
    if (!Overlap(own.z_m, neighbour.z_m)) continue;
    const Interval along = Shared(edge, other);
    if (!(along.length_m() > 0)) continue;
    const bool is_other = neighbour.building != own.building;
    const bool only_its_height = own.top_known && neighbour.top_known;
    // On a slope the ground under two buildings differs: there is no wall below a neighbour's foot.
    const Interval to_its_top{own.z_m.from_m, neighbour.z_m.to_m};
    covers.push_back({along,
                      !only_its_height ? own.z_m
                      : is_other       ? to_its_top
                                       : neighbour.z_m,
                      is_other});
  }
  return covers;
}

// The same where other buildings hide all of the edge that they touch, whatever their heights.
std::vector<Cover> WholePartyWalls(std::vector<Cover> covers, const Interval& z) {
  for (Cover& cover : covers) {
    if (cover.by_other_building) cover.z_m = z;
  }
  return covers;
}

// `whole` without the intervals, from low to high.
std::vector<Interval> Without(const Interval& whole, std::vector<Interval> taken) {
  std::sort(taken.begin(), taken.end(),
            [](const Interval& a, const Interval& b) { return a.from_m < b.from_m; });
  std::vector<Interval> left;
  double from = whole.from_m;
  for (const Interval& interval : taken) {
    if (interval.from_m > from) left.push_back({from, std::min(interval.from_m, whole.to_m)});
    from = std::max(from, interval.to_m);
    if (from >= whole.to_m) return left;
  }
  left.push_back({from, whole.to_m});
  return left;
}

// What stands free of an edge, cut where covers begin and end.
std::vector<Cover> FreePieces(double length, const Interval& z, const std::vector<Cover>& covers) {
  std::vector<double> stops = {0, length};
  for (const Cover& cover : covers) {
    stops.push_back(cover.along_m.from_m);
    stops.push_back(cover.along_m.to_m);
  }
  std::sort(stops.begin(), stops.end());
  std::vector<Cover> pieces;
  for (size_t i = 1; i < stops.size(); ++i) {
    const Interval along{stops[i - 1], stops[i]};
    if (!(along.length_m() > 0)) continue;
    std::vector<Interval> taken;
    for (const Cover& cover : covers) {
      if (Overlap(cover.along_m, along)) taken.push_back(cover.z_m);
    }
    for (const Interval& free : Without(z, taken)) {
      if (free.length_m() < (free == z ? kLeastHeight_m : kLeastUpperWall_m)) continue;
      const auto same = [&](const Cover& piece) {
        return piece.z_m == free && piece.along_m.to_m == along.from_m;
      };
      const auto before = std::find_if(pieces.begin(), pieces.end(), same);
      if (before != pieces.end()) {
        before->along_m.to_m = along.to_m;
      } else {
        pieces.push_back({along, free});
      }
    }
  }
  std::erase_if(pieces, [](const Cover& p) { return p.along_m.length_m() < kLeastLength_m; });
  return pieces;
}

// What stands free above other buildings only.
std::vector<Cover> PiecesAboveNeighbours(double length, const Interval& z,
                                         std::vector<Cover> covers) {
  std::vector<Interval> neighbours;
  for (const Cover& cover : covers) {
    if (cover.by_other_building) neighbours.push_back(cover.along_m);
  }
  if (neighbours.empty()) return {};
  for (const Interval& gap : Without({0, length}, neighbours)) covers.push_back({gap, z});
  return FreePieces(length, z, covers);
}

// F03, then F03b, F03c ... (F03-27 after the last letter).
std::string FacadeId(const std::string& building, int wall, int piece) {
  std::string id = fmt::format("{}/F{:02}", building, wall);
  if (piece >= 26) return fmt::format("{}-{}", id, piece + 1);
  if (piece > 0) id += static_cast<char>('a' + piece);
  return id;
}

// Facades on the edges [first, last) of one wall.
class WallFacades {
 public:
  WallFacades(const std::vector<Footprint>& footprints, const std::vector<Edge>& edges,
              std::vector<Facade>& facades)
      : footprints_(footprints), edges_(edges), facades_(facades) {}

  void Add(size_t first, size_t last, const BoxGrid& grid,
           const std::vector<Eigen::AlignedBox2d>& boxes) {
    const Interval& z = footprints_[edges_[first].footprint].z_m;
    std::vector<std::vector<Cover>> above(last - first);
    pieces_ = 0;
    for (size_t i = first; i < last; ++i) {
      const double length = (edges_[i].b - edges_[i].a).norm();
      const auto covers = CoversOf(edges_[i], grid.Touching(boxes[i]), edges_, footprints_);
      AddPieces(edges_[i], FreePieces(length, z, WholePartyWalls(covers, z)));
      above[i - first] = PiecesAboveNeighbours(length, z, covers);
    }
    for (size_t i = first; i < last; ++i) AddPieces(edges_[i], above[i - first]);
  }

 private:
  void AddPieces(const Edge& edge, const std::vector<Cover>& pieces) {
    const Footprint& footprint = footprints_[edge.footprint];
    const double length = (edge.b - edge.a).norm();
    const auto at = [&](double along) -> Eigen::Vector2d {
      if (along == length) return edge.b;
      return edge.a + along / length * (edge.b - edge.a);
    };
    for (const Cover& piece : pieces) {
      facades_.push_back({.id = FacadeId(footprint.building, edge.wall, pieces_++),
                          .footprint = edge.footprint,
                          .a = at(piece.along_m.from_m),
                          .b = at(piece.along_m.to_m),
                          .z_m = piece.z_m,
                          .top_known = footprint.top_known});
    }
  }

  const std::vector<Footprint>& footprints_;
  const std::vector<Edge>& edges_;
  std::vector<Facade>& facades_;
  int pieces_ = 0;  // of the wall so far
};

}  // namespace

Ring FromSouthWest(Ring ring) {
  const auto farther = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x() + a.y(), a.x()) < std::pair(b.x() + b.y(), b.x());
  };
  std::rotate(ring.begin(), std::min_element(ring.begin(), ring.end(), farther), ring.end());
  return ring;
}

std::vector<Facade> MakeFacades(const std::vector<Footprint>& footprints) {
  const std::vector<Edge> edges = EdgesOf(footprints);
  std::vector<Eigen::AlignedBox2d> boxes;
  boxes.reserve(edges.size());
  for (const Edge& edge : edges) {
    boxes.emplace_back(edge.a.cwiseMin(edge.b).array() - kSnap_m,
                       edge.a.cwiseMax(edge.b).array() + kSnap_m);
  }
  const BoxGrid grid(boxes, kCell_m);
  std::vector<Facade> facades;
  WallFacades walls(footprints, edges, facades);
  for (size_t first = 0, last = 0; first < edges.size(); first = last) {
    for (last = first; last < edges.size() && edges[last].footprint == edges[first].footprint &&
                       edges[last].wall == edges[first].wall;) {
      ++last;
    }
    const Footprint& footprint = footprints[edges[first].footprint];
    if (footprint.in_area) walls.Add(first, last, grid, boxes);
  }
  return facades;
}

}  // namespace stucco
