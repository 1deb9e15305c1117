// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <utility>

#include "proxy/facets/min_cut.h"
#include "proxy/solids/solid_cells.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

constexpr double kUncovered = 0.6;  // price of boundary without points, per area
constexpr double kArea = 0.05;      // of any boundary: fewer, larger facets

std::vector<bool> CutCells(const Partition& partition, const CellEvidence& evidence,
                           const std::vector<bool>& forbidden) {
  double most = 1;
  for (size_t f = 0; f < partition.faces.size(); ++f) most += partition.AreaOf(partition.faces[f]);
  std::vector<CutNode> nodes(partition.cells.size());
  for (size_t c = 0; c < nodes.size(); ++c) {
    nodes[c].cost_in = evidence.outside[c] + (forbidden[c] ? 10 * most : 0);
    nodes[c].cost_out = evidence.inside[c];
  }
  std::vector<CutLink> links;
  for (size_t f = 0; f < partition.faces.size(); ++f) {
    const auto& face = partition.faces[f];
    const double area = partition.AreaOf(face);
    const double open = std::max(0.0, area - evidence.covered[f]);
    const double cost = kUncovered * open + kArea * area;
    if (face.below >= 0 && face.above >= 0) {
      links.push_back({face.below, face.above, cost});
    } else {
      nodes[std::max(face.below, face.above)].cost_in += cost;
    }
  }
  return CheapestLabels(nodes, links);
}

// Cells with one label that touch in faces get one number, that of the last of them; the world
// around the box is one more empty cell.
std::vector<int> PartsOf(const Partition& partition, const std::vector<bool>& inside) {
  const int world = static_cast<int>(inside.size());
  DisjointSets parts(inside.size() + 1);
  const auto label = [&](int cell) { return cell < world && inside[cell]; };
  for (const auto& face : partition.faces) {
    const int a = face.below < 0 ? world : face.below, b = face.above < 0 ? world : face.above;
    if (label(a) == label(b)) parts.Join(a, b);
  }
  std::vector<int> last(inside.size() + 1);
  for (int i = 0; i <= world; ++i) last[parts.Find(i)] = i;
  std::vector<int> part_of(inside.size() + 1);
  for (int i = 0; i <= world; ++i) part_of[i] = last[parts.Find(i)];
  return part_of;
}

// Fills cavities and keeps the largest solid part.
void KeepOnePart(const Partition& partition, std::vector<bool>& inside) {
  auto parts = PartsOf(partition, inside);
  for (size_t c = 0; c < inside.size(); ++c) {
    if (!inside[c] && parts[c] != parts.back()) inside[c] = true;
  }
  parts = PartsOf(partition, inside);
  std::map<int, double> volume;
  for (size_t c = 0; c < inside.size(); ++c) {
    if (inside[c]) volume[parts[c]] += partition.VolumeOf(static_cast<int>(c));
  }
  int largest = -1;
  double most = -1;
  for (const auto& [part, v] : volume) {
    if (v <= most) continue;
    most = v;
    largest = part;
  }
  for (size_t c = 0; c < inside.size(); ++c) inside[c] = inside[c] && parts[c] == largest;
}

// Cells around an edge or vertex where the boundary is not a surface.
std::set<int> CellsAtBadEdges(const Partition& partition, const std::vector<bool>& inside) {
  const auto in = [&](int cell) { return cell >= 0 && inside[cell]; };
  std::map<std::pair<int, int>, int> count;
  const auto for_each_edge = [&](const Partition::Face& face, const auto& fn) {
    for (size_t i = 0; i < face.loop.size(); ++i) {
      const int a = face.loop[i], b = face.loop[(i + 1) % face.loop.size()];
      fn(std::pair<int, int>(std::min(a, b), std::max(a, b)));
    }
  };
  for (const auto& face : partition.faces) {
    if (in(face.below) == in(face.above)) continue;
    for_each_edge(face, [&](const auto& edge) { ++count[edge]; });
  }
  std::set<int> cells;
  for (const auto& face : partition.faces) {
    for_each_edge(face, [&](const auto& edge) {
      const auto found = count.find(edge);
      if (found == count.end() || found->second <= 2) return;
      if (face.below >= 0) cells.insert(face.below);
      if (face.above >= 0) cells.insert(face.above);
    });
  }
  return cells;
}

void RepairEdges(const Partition& partition, const std::vector<bool>& forbidden,
                 std::vector<bool>& inside) {
  constexpr int kMostFlips = 60;
  std::set<int> flipped;
  for (int round = 0; round < kMostFlips; ++round) {
    int smallest = -1;
    double least = 0;
    for (const int cell : CellsAtBadEdges(partition, inside)) {
      if (flipped.count(cell) != 0 || (forbidden[cell] && !inside[cell])) continue;
      const double volume = partition.VolumeOf(cell);
      if (smallest >= 0 && volume >= least) continue;
      smallest = cell;
      least = volume;
    }
    if (smallest < 0) return;
    flipped.insert(smallest);
    inside[smallest] = !inside[smallest];
    KeepOnePart(partition, inside);
  }
}

}  // namespace

std::vector<bool> LabelCells(const Partition& partition, const CellEvidence& evidence,
                             int ground_plane) {
  std::vector<bool> forbidden(partition.cells.size(), false);
  if (ground_plane >= 0) {
    const CutPlane& ground = partition.planes[ground_plane];
    for (size_t c = 0; c < forbidden.size(); ++c) {
      forbidden[c] = ground.normal.dot(partition.CenterOf(static_cast<int>(c))) < ground.offset;
    }
  }
  auto inside = CutCells(partition, evidence, forbidden);
  KeepOnePart(partition, inside);
  RepairEdges(partition, forbidden, inside);
  return inside;
}

}  // namespace stucco
