// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/scene/clusters.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

#include "proxy/scene/ground.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

using Cell = std::pair<int, int>;

// Connected components of the cells, diagonal neighbours included: cell -> label.
std::map<Cell, int> LabelCells(const std::map<Cell, int>& cells) {
  DisjointSets components(cells.size());
  for (const auto& [cell, index] : cells) {
    for (const auto& [dx, dy] : {Cell{1, 0}, Cell{0, 1}, Cell{1, 1}, Cell{1, -1}}) {
      const auto next = cells.find({cell.first + dx, cell.second + dy});
      if (next != cells.end()) components.Join(index, next->second);
    }
  }
  std::map<Cell, int> labels;
  for (const auto& [cell, index] : cells) labels[cell] = components.Find(index);
  return labels;
}

struct Extent {
  double area = 0;
  double above_ground = 0;
  double height = 0;  // from its lowest to its highest points
};

double At(double share, std::vector<double>& values) {
  const auto nth =
      values.begin() + static_cast<ptrdiff_t>(share * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), nth, values.end());
  return *nth;
}

// Heights without the last few points: leaves stand out of hedges.
Extent ExtentOf(const Samples& samples, const Eigen::Vector3d& up, const Plane* ground,
                const std::vector<Plane>& planes) {
  constexpr double kStrays = 0.02;  // of the points
  Extent extent;
  std::vector<double> heights;
  std::vector<double> above_ground;
  for (const Plane& plane : planes) {
    extent.area += plane.area;
    for (const int i : plane.points) {
      heights.push_back(up.dot(samples.positions[i]));
      if (ground != nullptr) above_ground.push_back(ground->DistanceTo(samples.positions[i]));
    }
  }
  if (heights.empty()) return extent;
  extent.height = At(1 - kStrays, heights) - At(kStrays, heights);
  if (!above_ground.empty()) extent.above_ground = At(1 - kStrays, above_ground);
  return extent;
}

}  // namespace

Clusters SplitIntoBuildings(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, std::span<const Plane> ground,
                            const std::vector<Plane>& planes) {
  // Cars are less than 12 times min_area and 6 levels of detail high. Points far apart raise those
  // two; cars do not grow with them, but a building must still be several facets.
  const double fewest_areas = std::max(3.0, 12 / (tolerances.coarseness * tolerances.coarseness));
  const double fewest_details = std::max(2.0, 6 / tolerances.coarseness);
  const Eigen::Vector3d east = AnyPerpendicular(up);
  const Eigen::Vector3d north = up.cross(east);
  const auto cell_of = [&](int i) {
    const Eigen::Vector3d& p = samples.positions[i];
    return Cell{static_cast<int>(std::floor(east.dot(p) / tolerances.fill_gap)),
                static_cast<int>(std::floor(north.dot(p) / tolerances.fill_gap))};
  };
  std::map<Cell, int> cells;
  for (const Plane& plane : planes) {
    for (const int i : plane.points) cells.emplace(cell_of(i), 0);
  }
  int next = 0;
  for (auto& [cell, index] : cells) index = next++;
  const auto labels = LabelCells(cells);
  std::map<int, std::vector<Plane>> groups;
  for (const Plane& plane : planes) {
    std::map<int, Plane> parts;
    for (const int i : plane.points) {
      Plane& part = parts[labels.at(cell_of(i))];
      part.points.push_back(i);
    }
    for (auto& [label, part] : parts) {
      part.normal = plane.normal;
      part.offset = plane.offset;
      part.role = plane.role;
      Measure(samples, 2.5 * tolerances.spacing, part);
      if (part.area >= tolerances.min_area) groups[label].push_back(std::move(part));
    }
  }
  Clusters clusters;
  std::vector<std::pair<double, std::vector<Plane>>> sized;
  for (auto& [label, group] : groups) {
    const Extent extent = ExtentOf(samples, up, GroundBelow(samples, up, ground, group), group);
    if (extent.area < fewest_areas * tolerances.min_area ||
        std::max(extent.height, extent.above_ground) <
            fewest_details * tolerances.level_of_detail) {
      ++clusters.dropped;
      continue;
    }
    sized.emplace_back(extent.area, std::move(group));
  }
  std::stable_sort(sized.begin(), sized.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first; });
  for (auto& [area, group] : sized) clusters.buildings.push_back(std::move(group));
  return clusters;
}

}  // namespace stucco
