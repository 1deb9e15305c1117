// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/internal/noding.h"

#include <algorithm>
#include <cmath>

#include "survey/geometry2d.h"

namespace stucco::plan::internal {
namespace {

constexpr double kPerMetre = 1000;  // coordinates are whole millimetres
constexpr double kCell_m = 5;       // about the length of a short wall

Eigen::Vector2d Rounded(const Eigen::Vector2d& p) {
  return {std::round(p.x() * kPerMetre) / kPerMetre, std::round(p.y() * kPerMetre) / kPerMetre};
}

// Marks the corners between `first` and `last` that must stay.
void KeepFarthest(const Ring& ring, size_t first, size_t last, double tolerance,
                  std::vector<bool>& keep) {
  std::vector<std::pair<size_t, size_t>> open = {{first, last}};
  while (!open.empty()) {
    const auto [from, to] = open.back();
    open.pop_back();
    double farthest = tolerance;
    size_t split = from;
    for (size_t i = from + 1; i < to; ++i) {
      const double distance = Distance(Segment2d{ring[from], ring[to % ring.size()]}, ring[i]);
      if (distance > farthest) {
        farthest = distance;
        split = i;
      }
    }
    if (split == from) continue;
    keep[split] = true;
    open.emplace_back(from, split);
    open.emplace_back(split, to);
  }
}

Eigen::AlignedBox2d BoxOf(const Eigen::Vector2d& a, const Eigen::Vector2d& b, double margin) {
  return {a.cwiseMin(b).array() - margin, a.cwiseMax(b).array() + margin};
}

// Every corner once, by place.
std::vector<Eigen::Vector2d> CornersOf(const std::vector<Polygon>& polygons) {
  std::vector<Eigen::Vector2d> corners;
  for (const Polygon& polygon : polygons) {
    for (const Ring& ring : polygon.rings) {
      corners.insert(corners.end(), ring.begin(), ring.end());
    }
  }
  std::sort(corners.begin(), corners.end(), [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x(), a.y()) < std::pair(b.x(), b.y());
  });
  corners.erase(std::unique(corners.begin(), corners.end()), corners.end());
  return corners;
}

}  // namespace

Ring Tidied(const Ring& ring) {
  Ring tidy;
  for (const Eigen::Vector2d& corner : ring) {
    if (!tidy.empty() && tidy.back() == corner) continue;
    if (tidy.size() > 1 && tidy[tidy.size() - 2] == corner) {
      tidy.pop_back();  // out to a corner and back
    } else {
      tidy.push_back(corner);
    }
  }
  while (tidy.size() > 1) {
    if (tidy.front() == tidy.back()) {
      tidy.pop_back();
    } else if (tidy.size() > 2 && tidy[tidy.size() - 2] == tidy.front()) {
      tidy.resize(tidy.size() - 2);
    } else if (tidy.size() > 2 && tidy[1] == tidy.back()) {
      tidy.erase(tidy.begin());
    } else {
      break;
    }
  }
  return tidy;
}

Ring Simplified(const Ring& ring, double tolerance_m) {
  if (ring.size() < 4) return ring;
  const auto lies_south_west = [](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return std::pair(a.x() + a.y(), a.x()) < std::pair(b.x() + b.y(), b.x());
  };
  Ring turned = ring;
  std::rotate(turned.begin(), std::min_element(turned.begin(), turned.end(), lies_south_west),
              turned.end());
  const auto nearer = [&](const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
    return (a - turned[0]).squaredNorm() < (b - turned[0]).squaredNorm();
  };
  const size_t farthest = std::max_element(turned.begin(), turned.end(), nearer) - turned.begin();
  std::vector<bool> keep(turned.size(), false);
  keep[0] = true;
  keep[farthest] = true;
  KeepFarthest(turned, 0, farthest, tolerance_m, keep);
  KeepFarthest(turned, farthest, turned.size(), tolerance_m, keep);
  Ring simple;
  for (size_t i = 0; i < turned.size(); ++i) {
    if (keep[i]) simple.push_back(turned[i]);
  }
  return simple;
}

bool Noder::Apply(std::vector<Polygon>& polygons) {
  // An edge that now bends may pass a further corner. Each bend uses one up, so this ends; the
  // bound is for safety.
  constexpr int kMostRounds = 5;
  bool changed = SnapCorners(polygons);
  for (int round = 0; round < kMostRounds && SplitEdges(polygons); ++round) changed = true;
  return changed;
}

Eigen::Vector2d Noder::Snapped(const Eigen::Vector2d& corner) {
  Eigen::Vector2d rounded = Rounded(corner);
  const Eigen::Array2d cell = (rounded / tolerance_m_).array().floor();
  const auto key = [](double column, double row) {
    return static_cast<int64_t>(row) * (int64_t{1} << 32) + static_cast<int64_t>(column);
  };
  double nearest = tolerance_m_;
  int found = -1;
  for (int row = -1; row <= 1; ++row) {
    for (int column = -1; column <= 1; ++column) {
      const auto points = by_cell_.find(key(cell.x() + column, cell.y() + row));
      if (points == by_cell_.end()) continue;
      for (const int point : points->second) {
        const double distance = (points_[point] - rounded).norm();
        if (distance > nearest || (distance == nearest && found >= 0)) continue;
        nearest = distance;
        found = point;
      }
    }
  }
  if (found >= 0) return points_[found];
  by_cell_[key(cell.x(), cell.y())].push_back(static_cast<int>(points_.size()));
  points_.push_back(rounded);
  return rounded;
}

bool Noder::SnapCorners(std::vector<Polygon>& polygons) {
  bool changed = false;
  for (Polygon& polygon : polygons) {
    for (Ring& ring : polygon.rings) {
      for (Eigen::Vector2d& corner : ring) {
        const Eigen::Vector2d snapped = Snapped(corner);
        changed = changed || snapped != corner;
        if ((snapped - corner).norm() > 1.5 / kPerMetre) ++moved_;
        corner = snapped;
      }
      ring = Tidied(ring);
    }
    std::erase_if(polygon.rings, [](const Ring& ring) { return ring.size() < 3; });
  }
  return changed;
}

bool Noder::SplitEdges(std::vector<Polygon>& polygons) const {
  const std::vector<Eigen::Vector2d> corners = CornersOf(polygons);
  std::vector<Eigen::AlignedBox2d> boxes;
  boxes.reserve(corners.size());
  for (const Eigen::Vector2d& corner : corners) boxes.emplace_back(corner, corner);
  const BoxGrid grid(boxes, kCell_m);
  bool changed = false;
  for (Polygon& polygon : polygons) {
    for (Ring& ring : polygon.rings) {
      Ring noded;
      for (size_t i = 0; i < ring.size(); ++i) {
        noded.push_back(ring[i]);
        AddPassed(ring[i], ring[(i + 1) % ring.size()], corners, grid, noded);
      }
      changed = changed || noded.size() != ring.size();
      ring = Tidied(noded);
    }
    std::erase_if(polygon.rings, [](const Ring& ring) { return ring.size() < 3; });
  }
  return changed;
}

void Noder::AddPassed(const Eigen::Vector2d& a, const Eigen::Vector2d& b,
                      std::span<const Eigen::Vector2d> corners, const BoxGrid& grid,
                      Ring& noded) const {
  std::vector<std::pair<double, int>> passed;
  for (const int index : grid.Touching(BoxOf(a, b, tolerance_m_))) {
    const Eigen::Vector2d& corner = corners[index];
    if (corner == a || corner == b) continue;
    const double t = (corner - a).dot(b - a) / (b - a).squaredNorm();
    if (!(t > 0 && t < 1) || Distance(Segment2d{a, b}, corner) > tolerance_m_) continue;
    passed.emplace_back(t, index);
  }
  std::sort(passed.begin(), passed.end());
  for (const auto& [t, index] : passed) noded.push_back(corners[index]);
}

}  // namespace stucco::plan::internal
