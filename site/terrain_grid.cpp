// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/terrain_grid.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco {
namespace {

// Position in samples from sample (0, 0), moved to the nearest point of the grid.
Eigen::Vector2d InSamples(const TerrainGrid& terrain, const Eigen::Vector2d& position) {
  const Eigen::Vector2d at = (position - terrain.corner) / terrain.step_m;
  return {std::clamp(at.x(), 0.0, terrain.columns - 1.0),
          std::clamp(at.y(), 0.0, terrain.rows - 1.0)};
}

double Sample(const TerrainGrid& terrain, int column, int row) {
  return terrain.z_m[static_cast<size_t>(row) * terrain.columns + column];
}

}  // namespace

double TerrainGrid::HeightAt(const Eigen::Vector2d& position) const {
  if (IsFlat()) return 0;
  const Eigen::Vector2d at = InSamples(*this, position);
  const int column = std::min(static_cast<int>(at.x()), std::max(0, columns - 2));
  const int row = std::min(static_cast<int>(at.y()), std::max(0, rows - 2));
  const double x = at.x() - column;
  const double y = at.y() - row;
  const int next_column = std::min(column + 1, columns - 1);
  const int next_row = std::min(row + 1, rows - 1);
  const double south = std::lerp(Sample(*this, column, row), Sample(*this, next_column, row), x);
  const double north =
      std::lerp(Sample(*this, column, next_row), Sample(*this, next_column, next_row), x);
  return std::lerp(south, north, y);
}

// Between samples the surface is extreme on grid lines (a bilinear patch has no peak inside), so
// that what the points of the rim miss is a fraction of the height differences within one cell.
double TerrainGrid::HighestAround(const Eigen::Vector2d& position, double radius_m) const {
  double highest = HeightAt(position);
  if (IsFlat() || !(radius_m > 0)) return highest;
  const Eigen::Vector2d reach(radius_m, radius_m);
  const Eigen::Vector2d low = InSamples(*this, position - reach);
  const Eigen::Vector2d high = InSamples(*this, position + reach);
  for (int row = static_cast<int>(std::ceil(low.y())); row <= high.y(); ++row) {
    for (int column = static_cast<int>(std::ceil(low.x())); column <= high.x(); ++column) {
      const Eigen::Vector2d at = corner + step_m * Eigen::Vector2d(column, row);
      if ((at - position).norm() <= radius_m)
        highest = std::max(highest, Sample(*this, column, row));
    }
  }
  constexpr double kPointsPerSample = 4;
  const double circumference = 2 * std::numbers::pi * radius_m;
  const int points = std::max(16, static_cast<int>(kPointsPerSample * circumference / step_m));
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    const Eigen::Vector2d rim(std::cos(angle), std::sin(angle));
    highest = std::max(highest, HeightAt(position + radius_m * rim));
  }
  return highest;
}

}  // namespace stucco
