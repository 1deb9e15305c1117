// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/roof_cells.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

#include "proxy/facets/raster.h"
#include "proxy/map/cell_labels.h"
#include "proxy/map/eaves.h"
#include "proxy/map/inner_walls.h"
#include "proxy/map/islands.h"
#include "proxy/map/roof_lines.h"
#include "proxy/map/roof_patches.h"
#include "survey/median.h"

namespace stucco {
namespace {

// Prices of the method: areas of samples explained wrongly against metres of border, which are
// worth the level of detail times these.
constexpr double kStepBorder = 0.6;
constexpr double kMeetingBorder = 0.1;
constexpr double kLooseSample = 0.25;  // on no plane: leaves, railings, chimneys
constexpr double kFarFromSamples = 0.1;
constexpr double kLevelRoof = 0.3;  // the roof of last resort
constexpr double kNoRoof = 0.3;     // the ground where nobody sees whether it lies open
constexpr double kForbidden = 1e3;  // a square metre of roof in the ground
constexpr double kMeets_m = 0.02;   // roofs nearer than this along a border meet there

RoofPlane RoofOf(const Plane& plane) {
  const double z = plane.normal.z();
  return {.slope = -plane.normal.head<2>() / z, .height = plane.offset / z};
}

// The face of the arrangement at each cell of the raster that lies inside the footprint.
std::vector<int> FaceOfCells(const PlaneRaster& raster, const Arrangement& arrangement,
                             const std::vector<int>& labels) {
  std::vector<int> faces(static_cast<size_t>(raster.width) * raster.height, -1);
  for (size_t f = 0; f < arrangement.faces.size(); ++f) {
    if (labels[f] < 0) continue;
    const Polygon cell{{RingOf(arrangement, f)}};
    const Eigen::AlignedBox2d box = BoundsOf(cell);
    const Eigen::Array2d low = (box.min() - raster.origin).array() / raster.cell;
    const Eigen::Array2d high = (box.max() - raster.origin).array() / raster.cell;
    for (int y = std::max(0, int(low.y())); y <= std::min(raster.height - 1, int(high.y())); ++y) {
      for (int x = std::max(0, int(low.x())); x <= std::min(raster.width - 1, int(high.x())); ++x) {
        if (Contains(cell, raster.Center(x, y))) faces[raster.Index(x, y)] = int(f);
      }
    }
  }
  return faces;
}

// The cost of no roof, after those of the roofs, in a cell so far from where the ground lies open,
// whose samples above the ground are worth `trust`.
void AddOpen(float to_open, double trust, const Tolerances& tolerances,
             std::vector<double>& costs) {
  if (to_open == 0) {
    for (double& cost : costs) cost += 1;
    costs.push_back(0);
  } else {
    costs.push_back(to_open > tolerances.fill_gap ? 1 : kNoRoof + trust);
  }
}

// The costs of the raster's cells by roof: the mean over their samples of how far these lie from
// it, up to twice the level of detail. Where the ground lies open somewhere, one cost more: that of
// no roof. Cells with fewer than half of the samples that the cloud's spacing promises say less:
// what grazing views leave there is as likely wrong as right.
using Costs = std::vector<std::vector<double>>;
Costs CostsOf(const RoofEvidence& evidence, std::span<const int> planes, const CoverOfRoofs& cover,
              const std::vector<RoofPlane>& roofs, const Tolerances& tolerances) {
  const size_t cells = static_cast<size_t>(cover.raster.width) * cover.raster.height;
  std::vector<bool> on_plane(evidence.samples.size(), false);
  for (const int p : planes) {
    for (const int i : evidence.planes[p].points) on_plane[i] = true;
  }
  Costs costs(cells, std::vector<double>(roofs.size(), 0));
  std::vector<double> weights(cells, 0), most(cells, 0), counts(cells, 0);
  const double enough = EnoughSamples(cover.raster.cell, tolerances.spacing);
  const double farthest = 2 * tolerances.level_of_detail;
  for (size_t i = 0; i < evidence.samples.size(); ++i) {
    const Eigen::Vector3d& p = evidence.samples.positions[i];
    const int at = cover.raster.IndexAt(p.head<2>());
    if (at < 0) continue;
    const double weight = on_plane[i] ? 1 : kLooseSample;
    for (size_t k = 0; k < roofs.size(); ++k) {
      const double off =
          std::abs(p.z() - roofs[k].At(p.head<2>())) / std::sqrt(1 + roofs[k].slope.squaredNorm());
      costs[at][k] += weight * std::min(1.0, off / farthest);
    }
    weights[at] += weight;
    most[at] = std::max(most[at], weight);
    ++counts[at];
  }
  for (size_t at = 0; at < cells; ++at) {
    const double trust = most[at] * std::min(1.0, counts[at] / enough);
    for (size_t k = 0; k < roofs.size(); ++k) {
      if (weights[at] > 0) costs[at][k] *= trust / weights[at];
      const bool level = k + 1 == roofs.size();
      if (level) {
        costs[at][k] += kLevelRoof;
      } else if (cover.to_hit[k][at] > tolerances.fill_gap) {
        costs[at][k] += kFarFromSamples;
      }
    }
    if (!cover.to_open.empty()) AddOpen(cover.to_open[at], trust, tolerances, costs[at]);
  }
  return costs;
}

// Labels are the roofs and, where the ground lies `open` somewhere, after them none.
CellProblem ProblemOf(const RoofCells& roof, const std::vector<int>& cell_of_face, bool open,
                      const Tolerances& tolerances) {
  CellProblem problem;
  const int none = static_cast<int>(roof.roofs.size());
  problem.labels = none + (open ? 1 : 0);
  std::vector<const Arrangement::Edge*> edges;
  for (const Arrangement::Edge& edge : roof.arrangement.edges) {
    if (edge.left < 0 || edge.right < 0) continue;
    if (cell_of_face[edge.left] < 0 || cell_of_face[edge.right] < 0) continue;
    problem.links.push_back({cell_of_face[edge.left], cell_of_face[edge.right]});
    edges.push_back(&edge);
  }
  problem.border = [&roof, edges, none, detail = tolerances.level_of_detail](size_t link, int a,
                                                                             int b) {
    if (a == b) return 0.0;
    const Eigen::Vector2d p = roof.arrangement.vertices[edges[link]->from];
    const Eigen::Vector2d q = roof.arrangement.vertices[edges[link]->to];
    if (a == none || b == none) return kStepBorder * detail * (q - p).norm();
    const double step = std::max(std::abs(roof.roofs[a].At(p) - roof.roofs[b].At(p)),
                                 std::abs(roof.roofs[a].At(q) - roof.roofs[b].At(q)));
    const double price = step < kMeets_m ? kMeetingBorder + step / detail : kStepBorder;
    return price * detail * (q - p).norm();
  };
  return problem;
}

// Inside: 0, outside: -1.
std::vector<int> InsideOf(const Arrangement& arrangement, const MapBuilding& building) {
  std::vector<int> labels;
  for (size_t f = 0; f < arrangement.faces.size(); ++f) {
    const Eigen::Vector2d middle = InnerPoint(arrangement, f);
    const bool inside = std::ranges::any_of(
        building.parts, [&](const Polygon& part) { return Contains(part, middle); });
    labels.push_back(inside ? 0 : -1);
  }
  return labels;
}

// Faces of the arrangement inside of the footprint, and the other way round (-1: outside).
struct CellNumbers {
  std::vector<int> face_of_cell;
  std::vector<int> cell_of_face;
};

CellNumbers NumberCells(const std::vector<int>& labels) {
  CellNumbers numbers{{}, std::vector<int>(labels.size(), -1)};
  for (size_t f = 0; f < labels.size(); ++f) {
    if (labels[f] < 0) continue;
    numbers.cell_of_face[f] = static_cast<int>(numbers.face_of_cell.size());
    numbers.face_of_cell.push_back(static_cast<int>(f));
  }
  return numbers;
}

// What each cell of the footprint costs under each roof: its area times the mean of the raster's
// cells within it. A sliver that holds no centre of them costs what the one around its middle does.
std::vector<std::vector<double>> DataOf(const RoofCells& roof, const CellNumbers& numbers,
                                        const PlaneRaster& raster, const Costs& costs) {
  const size_t labels = costs.front().size();
  std::vector<std::vector<double>> data(numbers.face_of_cell.size(),
                                        std::vector<double>(labels, 0));
  std::vector<int> counts(data.size(), 0);
  const auto add = [&](size_t cell, size_t at) {
    for (size_t k = 0; k < labels; ++k) data[cell][k] += costs[at][k];
    ++counts[cell];
  };
  const std::vector<int> face_at = FaceOfCells(raster, roof.arrangement, roof.labels);
  for (size_t at = 0; at < face_at.size(); ++at) {
    if (face_at[at] >= 0) add(numbers.cell_of_face[face_at[at]], at);
  }
  for (size_t c = 0; c < data.size(); ++c) {
    if (counts[c] == 0) {
      const int at = raster.IndexAt(InnerPoint(roof.arrangement, numbers.face_of_cell[c]));
      if (at >= 0) add(c, at);
    }
    const double area = SignedArea(RingOf(roof.arrangement, numbers.face_of_cell[c]));
    for (double& cost : data[c]) cost *= area / std::max(1, counts[c]);
  }
  return data;
}

bool AreSame(const std::vector<RoofPlane>& some, const std::vector<RoofPlane>& others) {
  return std::ranges::equal(some, others, [](const RoofPlane& a, const RoofPlane& b) {
    return a.slope == b.slope && a.height == b.height;
  });
}

// Whether a roof comes nearer to the ground than a building's may, over a face.
bool IsBuried(const RoofCells& roof, size_t label, int face, double ground) {
  return std::ranges::any_of(roof.arrangement.faces[face], [&](int v) {
    return roof.roofs[label].At(roof.arrangement.vertices[v]) - ground < kRaised_m / 2;
  });
}

// Gives the cells between the roof's lines their labels.
void Label(const RoofTask& task, const CoverOfRoofs& cover, RoofCells& roof) {
  const auto& [building, evidence, planes, tolerances] = task;
  roof.arrangement = Arrange(BoxAround(building.building), roof.lines);
  roof.labels = InsideOf(roof.arrangement, building.building);
  const CellNumbers numbers = NumberCells(roof.labels);
  const std::vector<int>& face_of_cell = numbers.face_of_cell;
  CellProblem problem = ProblemOf(roof, numbers.cell_of_face, !cover.to_open.empty(), tolerances);
  const Costs costs = CostsOf(evidence, planes, cover, roof.roofs, tolerances);
  problem.data = DataOf(roof, numbers, cover.raster, costs);
  for (size_t c = 0; c < face_of_cell.size(); ++c) {
    for (size_t k = 0; k + 1 < roof.roofs.size(); ++k) {
      if (IsBuried(roof, k, face_of_cell[c], building.ground)) problem.data[c][k] = kForbidden;
    }
  }
  std::vector<int> labels = CheapestCellLabels(problem);
  const int none = static_cast<int>(roof.roofs.size());
  TidyPatches({.arrangement = roof.arrangement,
               .lines = roof.lines,
               .face_of_cell = face_of_cell,
               .cell_of_face = numbers.cell_of_face,
               .problem = problem,
               .roofs = roof.roofs,
               .axis = roof.lines.front().direction,
               .level_of_detail = tolerances.level_of_detail,
               .forbidden = kForbidden},
              labels);
  for (size_t c = 0; c < labels.size(); ++c) {
    roof.labels[face_of_cell[c]] = labels[c] == none ? -1 : labels[c];
  }
  std::vector<bool> inside(roof.labels.size(), false);
  for (const int face : face_of_cell) inside[face] = true;
  DropIslands(roof.arrangement, cover, tolerances.fill_gap, inside, roof.labels);
  DropShortWalls(roof.arrangement, roof.lines, roof.roofs, inside, roof.labels);
  JoinAtCorners(roof.arrangement, roof.roofs, inside, roof.labels);
}

}  // namespace

RoofCells LabelRoof(const FittedBuilding& building, const RoofEvidence& evidence,
                    std::span<const int> planes, const Tolerances& tolerances) {
  const RoofTask task{building, evidence, planes, tolerances};
  RoofCells roof;
  std::vector<double> heights;
  for (const int p : planes) {
    roof.roofs.push_back(RoofOf(evidence.planes[p]));
    for (const int i : evidence.planes[p].points) {
      heights.push_back(evidence.samples.positions[i].z());
    }
  }
  const std::vector<RoofPlane> as_found = roof.roofs;
  LevelEaves(building, evidence, planes, tolerances, roof.roofs);
  const CoverOfRoofs cover = CoverOf(task);
  const RoofPlane level{.height = Median(heights).value_or(building.ground + kRaised_m)};
  roof.roofs.push_back(level);
  roof.lines = LinesOf(task, cover, roof.roofs);
  Label(task, cover, roof);

  // Eaves over walls that are no edges of the footprint are known only now.
  FittedBuilding walled = building;
  const auto edges =
      static_cast<int>(EdgeLines(building.building, BoxAround(building.building)).size());
  for (const Segment2d& wall :
       InnerWalls(roof.arrangement, roof.lines, edges, roof.roofs, roof.labels)) {
    walled.edges.push_back({.line = wall, .facades = {}});
  }
  if (walled.edges.size() == building.edges.size()) return roof;
  RoofCells again{.arrangement = {}, .lines = {}, .roofs = as_found, .labels = {}};
  LevelEaves(walled, evidence, planes, tolerances, again.roofs);
  again.roofs.push_back(level);
  if (AreSame(again.roofs, roof.roofs)) return roof;
  again.lines = WithCreases(task, roof.lines, CreasesOf(cover, again.roofs, tolerances));
  Label(task, cover, again);
  return again;
}

RoofCells FlatRoof(const MapBuilding& building, double height) {
  RoofCells roof;
  roof.roofs = {{.height = height}};
  const Eigen::AlignedBox2d box = BoxAround(building);
  roof.lines = EdgeLines(building, box);
  roof.arrangement = Arrange(box, roof.lines);
  roof.labels = InsideOf(roof.arrangement, building);
  return roof;
}

}  // namespace stucco
