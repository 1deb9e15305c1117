// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/scene/planes_in_plan.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>

namespace stucco {

PlanesInPlan::PlanesInPlan(const Samples& samples, const Tolerances& tolerances,
                           const Eigen::Vector3d& up, const std::vector<Plane>& planes)
    : planes_(planes), up_(up), cells_(planes.size()) {
  constexpr double kDetailsPerCell = 5;  // 1.5 m
  constexpr double kPointsPerCell = 4;
  constexpr double kDetailsPerStep = 2;  // kerbs, steps and low walls are no eaves
  cell_ =
      std::max(kDetailsPerCell * tolerances.level_of_detail, kPointsPerCell * tolerances.spacing);
  step_ = kDetailsPerStep * tolerances.level_of_detail;
  const Eigen::Vector3d east = AnyPerpendicular(up);
  const Eigen::Vector3d north = up.cross(east);
  for (size_t p = 0; p < planes.size(); ++p) {
    for (const int i : planes[p].points) {
      const Eigen::Vector3d& position = samples.positions[i];
      const Cell cell{static_cast<int>(std::floor(east.dot(position) / cell_)),
                      static_cast<int>(std::floor(north.dot(position) / cell_))};
      auto& spots = spots_[cell];
      const double height = up.dot(position);
      // Planes come one after another: a plane's spot is the last one.
      if (spots.empty() || spots.back().plane != static_cast<int>(p)) {
        spots.push_back({static_cast<int>(p), height, position});
        cells_[p].push_back(cell);
      } else if (height < spots.back().low) {
        spots.back().low = height;
        spots.back().position = position;
      }
    }
    std::sort(cells_[p].begin(), cells_[p].end());
  }
}

// Negative below the plane, along up.
double PlanesInPlan::HeightOver(int plane, const Eigen::Vector3d& position) const {
  return planes_[plane].DistanceTo(position) / planes_[plane].normal.dot(up_);
}

// What the terrain may fall or rise by on the way to a cell that far.
double PlanesInPlan::StepAt(int steps) const {
  constexpr double kBend = 0.18;  // ten degrees from one plane of the terrain to the next
  return step_ + kBend * steps * cell_;
}

// What lies across the plane's border: from each of its outer cells in the four directions the
// first cell with points, as far as walls hide the ground from photos. The outer cells themselves
// count too: walls end in them.
std::vector<PlanesInPlan::Neighbour> PlanesInPlan::Around(int plane) const {
  constexpr int kFarthest = 4;
  const auto& own = cells_[plane];
  const auto is_own = [&](const Cell& cell) {
    return std::binary_search(own.begin(), own.end(), cell);
  };
  std::vector<Neighbour> around;
  for (const Cell& cell : own) {
    for (const auto& [dx, dy] : {Cell{1, 0}, Cell{-1, 0}, Cell{0, 1}, Cell{0, -1}}) {
      if (is_own({cell.first + dx, cell.second + dy})) continue;
      Neighbour here{&spots_.at(cell), 0};
      if (here.spots->size() > 1) around.push_back(here);
      for (int k = 1; k <= kFarthest; ++k) {
        const Cell next{cell.first + k * dx, cell.second + k * dy};
        if (is_own(next)) break;
        const auto found = spots_.find(next);
        if (found == spots_.end()) continue;
        around.push_back({&found->second, k});
        break;
      }
    }
  }
  return around;
}

bool PlanesInPlan::IsLowest(int plane) const {
  constexpr double kMayFall = 0.3;
  size_t falls = 0, all = 0;
  for (const auto& [spots, steps] : Around(plane)) {
    double lowest = std::numeric_limits<double>::infinity();
    for (const Spot& spot : *spots) {
      if (spot.plane != plane) lowest = std::min(lowest, HeightOver(plane, spot.position));
    }
    ++all;
    falls += lowest < -StepAt(std::max(1, steps));
  }
  return static_cast<double>(falls) <= kMayFall * static_cast<double>(all);
}

bool PlanesInPlan::Continues(int plane, int other) const {
  for (const auto& [spots, steps] : Around(plane)) {
    for (const Spot& spot : *spots) {
      if (spot.plane == other &&
          std::abs(HeightOver(plane, spot.position)) < StepAt(std::max(1, steps))) {
        return true;
      }
    }
  }
  return false;
}

int PlanesInPlan::Nearest(int plane, std::span<const int> others) const {
  assert(!others.empty());
  int best = others.front();
  double nearest = std::numeric_limits<double>::infinity();
  const Cell from = cells_[plane][cells_[plane].size() / 2];
  for (const int other : others) {
    for (const Cell& cell : cells_[other]) {
      const double distance = std::hypot(cell.first - from.first, cell.second - from.second);
      if (distance >= nearest) continue;
      nearest = distance;
      best = other;
    }
  }
  return best;
}

}  // namespace stucco
