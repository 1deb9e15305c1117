// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/grid_cells.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/geometry2d.h"

namespace stucco {
namespace {

int32_t CellOf(double coordinate, double size_m) {
  return static_cast<int32_t>(std::floor(coordinate / size_m));
}

// Where the row through y crosses the rings of the polygon, ascending.
void Crossings(const Polygon& polygon, double y, std::vector<double>& out) {
  out.clear();
  for (const Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      const Eigen::Vector2d& a = ring[i];
      const Eigen::Vector2d& b = ring[(i + 1) % ring.size()];
      if ((a.y() <= y) == (b.y() <= y)) continue;
      out.push_back(a.x() + (y - a.y()) / (b.y() - a.y()) * (b.x() - a.x()));
    }
  }
  std::ranges::sort(out);
}

// Counter-clockwise convex hull (Andrew's monotone chain, 1979).
Ring HullOf(Ring points) {
  std::ranges::sort(points, [](const auto& a, const auto& b) {
    return a.x() != b.x() ? a.x() < b.x() : a.y() < b.y();
  });
  Ring hull;
  for (int side = 0; side < 2; ++side) {
    const size_t first = hull.size();
    for (const Eigen::Vector2d& point : points) {
      while (hull.size() >= first + 2 &&
             !(Cross(hull.back() - hull[hull.size() - 2], point - hull.back()) > 0)) {
        hull.pop_back();
      }
      hull.push_back(point);
    }
    hull.pop_back();
    std::ranges::reverse(points);
  }
  return hull;
}

void AddCellsNear(const Segment2d& edge, double size_m, double reach_m,
                  std::vector<GridCell>& out) {
  const Eigen::Vector2d low = edge.a.cwiseMin(edge.b).array() - reach_m;
  const Eigen::Vector2d high = edge.a.cwiseMax(edge.b).array() + reach_m;
  for (int32_t row = CellOf(low.y(), size_m); row <= CellOf(high.y(), size_m); ++row) {
    for (int32_t column = CellOf(low.x(), size_m); column <= CellOf(high.x(), size_m); ++column) {
      const GridCell cell{row, column};
      if (Distance(edge, CenterOf(cell, size_m)) <= reach_m) out.push_back(cell);
    }
  }
}

}  // namespace

std::vector<GridCell> CellsInside(const Polygon& polygon, double size_m) {
  std::vector<GridCell> out;
  if (polygon.rings.empty() || polygon.rings.front().empty()) return out;
  double low = std::numeric_limits<double>::max();
  double high = std::numeric_limits<double>::lowest();
  for (const Eigen::Vector2d& corner : polygon.rings.front()) {
    low = std::min(low, corner.y());
    high = std::max(high, corner.y());
  }
  std::vector<double> crossings;
  for (int32_t row = CellOf(low, size_m); row <= CellOf(high, size_m); ++row) {
    Crossings(polygon, (row + 0.5) * size_m, crossings);
    for (size_t i = 0; i + 1 < crossings.size(); i += 2) {
      const auto first = static_cast<int32_t>(std::ceil(crossings[i] / size_m - 0.5));
      const auto last = static_cast<int32_t>(std::floor(crossings[i + 1] / size_m - 0.5));
      for (int32_t column = first; column <= last; ++column) out.push_back({row, column});
    }
  }
  return out;
}

std::vector<GridCell> CellsNear(const Polygon& polygon, double size_m, double reach_m) {
  std::vector<GridCell> out;
  for (const Ring& ring : polygon.rings) {
    for (size_t i = 0; i < ring.size(); ++i) {
      AddCellsNear({ring[i], ring[(i + 1) % ring.size()]}, size_m, reach_m, out);
    }
  }
  std::ranges::sort(out);
  out.erase(std::unique(out.begin(), out.end()), out.end());
  return out;
}

std::vector<GridCell> CellsNearLine(const Segment2d& line, double size_m, double reach_m) {
  std::vector<GridCell> out;
  AddCellsNear(line, size_m, reach_m, out);
  return out;
}

Eigen::Vector2d MainAxis(const Polygon& polygon) {
  Eigen::Vector2d best = Eigen::Vector2d::UnitX();
  if (polygon.rings.empty()) return best;
  const Ring hull = HullOf(polygon.rings.front());
  double least = std::numeric_limits<double>::max();
  for (size_t i = 0; i < hull.size(); ++i) {
    const Eigen::Vector2d edge = hull[(i + 1) % hull.size()] - hull[i];
    if (!(edge.norm() > 0)) continue;
    const Eigen::Vector2d u = edge.normalized();
    const Eigen::Vector2d v(-u.y(), u.x());
    Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
    Eigen::Vector2d high = -low;
    for (const Eigen::Vector2d& corner : hull) {
      const Eigen::Vector2d at(corner.dot(u), corner.dot(v));
      low = low.cwiseMin(at);
      high = high.cwiseMax(at);
    }
    const Eigen::Vector2d size = high - low;
    // Rounding must not decide between the sides of one rectangle.
    if (size.prod() >= least * (1 - 1e-9)) continue;
    least = size.prod();
    best = size.x() >= size.y() ? u : v;
  }
  return best.x() < -1e-12 || (std::abs(best.x()) <= 1e-12 && best.y() < 0) ? -best : best;
}

}  // namespace stucco
