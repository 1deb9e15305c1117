// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/map/terrain.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace stucco::plan {
namespace {

// Position in samples from sample (0, 0), moved to the nearest point of the grid.
Eigen::Vector2d InSamples(const Terrain& terrain, const Eigen::Vector2d& position) {
  const Eigen::Vector2d at = (position - terrain.corner) / terrain.step_m;
  return {std::clamp(at.x(), 0.0, terrain.columns - 1.0),
          std::clamp(at.y(), 0.0, terrain.rows - 1.0)};
}

double Sample(const Terrain& terrain, int column, int row) {
  return terrain.z_m[static_cast<size_t>(row) * terrain.columns + column];
}

// Calls visit(height) for every sample within the radius and for points around the rim. Between
// samples the surface is extreme on grid lines (a bilinear patch has no peak inside), so that what
// the rim points miss is a fraction of the height differences within one cell.
template <class Visit>
void VisitAround(const Terrain& terrain, const Eigen::Vector2d& position, double radius_m,
                 const Visit& visit) {
  visit(terrain.HeightAt(position));
  if (!(radius_m > 0)) return;
  const Eigen::Vector2d reach(radius_m, radius_m);
  const Eigen::Vector2d low = InSamples(terrain, position - reach);
  const Eigen::Vector2d high = InSamples(terrain, position + reach);
  for (int row = static_cast<int>(std::ceil(low.y())); row <= high.y(); ++row) {
    for (int column = static_cast<int>(std::ceil(low.x())); column <= high.x(); ++column) {
      const Eigen::Vector2d at = terrain.corner + terrain.step_m * Eigen::Vector2d(column, row);
      if ((at - position).norm() <= radius_m) visit(Sample(terrain, column, row));
    }
  }
  constexpr double kPointsPerSample = 4;
  const double circumference = 2 * std::numbers::pi * radius_m;
  const int points =
      std::max(16, static_cast<int>(kPointsPerSample * circumference / terrain.step_m));
  for (int i = 0; i < points; ++i) {
    const double angle = 2 * std::numbers::pi * i / points;
    visit(
        terrain.HeightAt(position + radius_m * Eigen::Vector2d(std::cos(angle), std::sin(angle))));
  }
}

// Parameters in (0, 1) at which the segment crosses grid lines of one axis.
void AddCrossings(double from, double to, int samples, std::vector<double>& parameters) {
  if (from == to) return;
  const double first = std::max(0.0, std::ceil(std::min(from, to)));
  const double last = std::min(samples - 1.0, std::floor(std::max(from, to)));
  for (double line = first; line <= last; ++line) parameters.push_back((line - from) / (to - from));
}

// Highest value on [0, 1] of the parabola through (0, a), (1/2, b), (1, c).
double HighestOfParabola(double a, double b, double c) {
  const double highest = std::max({a, b, c});
  const double bend = 2 * (a - 2 * b + c);
  if (!(bend < 0)) return highest;
  const double slope = -3 * a + 4 * b - c;
  const double peak = -slope / (2 * bend);
  if (!(peak > 0 && peak < 1)) return highest;
  return std::max(highest, a + slope * peak + bend * peak * peak);
}

}  // namespace

double Terrain::HeightAt(const Eigen::Vector2d& position) const {
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

double Terrain::HighestAround(const Eigen::Vector2d& position, double radius_m) const {
  if (IsFlat()) return 0;
  double highest = HeightAt(position);
  VisitAround(*this, position, radius_m, [&](double z) { highest = std::max(highest, z); });
  return highest;
}

double Terrain::LowestAround(const Eigen::Vector2d& position, double radius_m) const {
  if (IsFlat()) return 0;
  double lowest = HeightAt(position);
  VisitAround(*this, position, radius_m, [&](double z) { lowest = std::min(lowest, z); });
  return lowest;
}

// Between two grid lines the ground under a segment is a parabola, so the result is exact.
double Terrain::HighestBetween(const Eigen::Vector2d& p, const Eigen::Vector2d& q) const {
  if (IsFlat()) return 0;
  const Eigen::Vector2d from = (p - corner) / step_m;
  const Eigen::Vector2d to = (q - corner) / step_m;
  std::vector<double> stops = {0, 1};
  AddCrossings(from.x(), to.x(), columns, stops);
  AddCrossings(from.y(), to.y(), rows, stops);
  std::sort(stops.begin(), stops.end());
  const auto height = [&](double t) { return HeightAt(p + t * (q - p)); };
  double highest = height(0);
  for (size_t i = 1; i < stops.size(); ++i) {
    highest = std::max(
        highest, HighestOfParabola(height(stops[i - 1]), height((stops[i - 1] + stops[i]) / 2),
                                   height(stops[i])));
  }
  return highest;
}

}  // namespace stucco::plan
