// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/imported/measure_support.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <vector>

#include "proxy/cloud/near_facets.h"
#include "survey/geometry2d.h"

namespace stucco {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr size_t kMostPoints = 3'000'000;
constexpr double kCellsOfSide = 100;

// What lies on a facet, in cells of its plane.
class FacetCells {
 public:
  FacetCells(const Facet& facet, double cell) : facet_(facet) {
    u_ = facet.normal.unitOrthogonal();
    v_ = facet.normal.cross(u_);
    polygon_.rings.push_back(InPlane(facet.outer));
    for (const auto& hole : facet.holes) polygon_.rings.push_back(InPlane(hole));
    bounds_ = BoundsOf(polygon_);
    cell_ = std::max(cell, bounds_.sizes().maxCoeff() / kCellsOfSide);
    columns_ = static_cast<size_t>(bounds_.sizes().x() / cell_) + 1;
    const size_t rows = static_cast<size_t>(bounds_.sizes().y() / cell_) + 1;
    hit_.resize(columns_ * rows);
  }

  void Add(const Vector3d& p, double reach) {
    const double distance = facet_.normal.dot(p) - facet_.offset;
    if (std::abs(distance) > reach) return;
    const Vector2d at = Flat(p);
    if (!bounds_.contains(at) || !Contains(polygon_, at)) return;
    ++points_;
    squares_ += distance * distance;
    const Vector2d cell = (at - bounds_.min()) / cell_;
    hit_[static_cast<size_t>(cell.y()) * columns_ + static_cast<size_t>(cell.x())] = 1;
  }

  void Write(Facet& facet) const {
    facet.support = static_cast<int>(points_);
    facet.rms = points_ > 0 ? std::sqrt(squares_ / static_cast<double>(points_)) : 0;
    facet.seen = SeenShare();
    facet.inferred = 1 - facet.seen;
  }

 private:
  Vector2d Flat(const Vector3d& p) const { return {u_.dot(p), v_.dot(p)}; }
  Ring InPlane(const std::vector<Vector3d>& corners) const {
    Ring ring;
    ring.reserve(corners.size());
    for (const Vector3d& p : corners) ring.push_back(Flat(p));
    return ring;
  }

  // Of the cells whose middle lies in the facet, or that have points, those that have points.
  double SeenShare() const {
    size_t inside = 0;
    size_t hit = 0;
    for (size_t i = 0; i < hit_.size(); ++i) {
      const size_t row = i / columns_;
      const Vector2d middle =
          bounds_.min() +
          cell_ * Vector2d(static_cast<double>(i % columns_) + 0.5, static_cast<double>(row) + 0.5);
      hit += hit_[i];
      inside += hit_[i] != 0 || Contains(polygon_, middle);
    }
    return inside > 0 ? static_cast<double>(hit) / static_cast<double>(inside) : 0;
  }

  const Facet& facet_;
  Vector3d u_, v_;
  Polygon polygon_;
  Eigen::AlignedBox2d bounds_;
  double cell_ = 0;
  size_t columns_ = 0;
  std::vector<char> hit_;
  size_t points_ = 0;
  double squares_ = 0;
};

}  // namespace

void MeasureSupport(const PointStream& cloud, double reach, double cell, Proxy& proxy) {
  std::vector<Facet*> facets;
  std::vector<FacetCells> cells;
  for (Building& building : proxy.buildings) {
    for (Facet& facet : building.facets) {
      facets.push_back(&facet);
      cells.emplace_back(facet, cell);
    }
  }
  const std::vector<const Facet*> fixed(facets.begin(), facets.end());
  ForEachPointNear(cloud, fixed, reach, kMostPoints, [&](size_t facet, const CloudPoint& point) {
    cells[facet].Add(point.position, reach);
  });
  for (size_t i = 0; i < facets.size(); ++i) cells[i].Write(*facets[i]);
}

}  // namespace stucco
