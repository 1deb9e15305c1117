// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/sight/visibility.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "plan/sight/internal/sweep.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr double kCellM = 25;
constexpr int kMaxCells = 1 << 22;

// The part of the wall within `radius_m` of p, in metres from a.
std::optional<Interval> WithinRadius(const Wall& wall, const Vector2d& p, double radius_m) {
  const Vector2d along = (wall.b - wall.a).normalized();
  const double foot = (p - wall.a).dot(along);
  const double distance = std::abs(Cross(along, p - wall.a));
  if (!(distance < radius_m)) return std::nullopt;
  const double half = std::sqrt(radius_m * radius_m - distance * distance);
  return Intersection(Interval{foot - half, foot + half}, {0, (wall.b - wall.a).norm()});
}

}  // namespace

Visibility::Visibility(std::vector<Wall> walls) : walls_(std::move(walls)) {
  Vector2d low = Vector2d::Constant(std::numeric_limits<double>::infinity()), high = -low;
  for (const Wall& wall : walls_) {
    const Vector2d middle = (wall.a + wall.b) / 2;
    low = low.cwiseMin(middle);
    high = high.cwiseMax(middle);
    reach_m_ = std::max(reach_m_, (wall.b - wall.a).norm() / 2);
  }
  if (walls_.empty()) low = high = Vector2d::Zero();
  corner_ = low;
  const Vector2d size = high - low;
  cell_m_ = std::max(kCellM, std::sqrt(size.x() * size.y() / kMaxCells));
  columns_ = static_cast<int>(size.x() / cell_m_) + 1;
  rows_ = static_cast<int>(size.y() / cell_m_) + 1;

  const auto cell_of = [&](const Wall& wall) {
    const Vector2d at = ((wall.a + wall.b) / 2 - corner_) / cell_m_;
    return std::min(static_cast<int>(at.y()), rows_ - 1) * columns_ +
           std::min(static_cast<int>(at.x()), columns_ - 1);
  };
  cell_begin_.assign(static_cast<size_t>(columns_) * rows_ + 1, 0);
  for (const Wall& wall : walls_) ++cell_begin_[cell_of(wall) + 1];
  for (size_t i = 1; i < cell_begin_.size(); ++i) cell_begin_[i] += cell_begin_[i - 1];
  cell_walls_.resize(walls_.size());
  std::vector<int> next(cell_begin_.begin(), cell_begin_.end() - 1);
  for (size_t i = 0; i < walls_.size(); ++i) {
    cell_walls_[next[cell_of(walls_[i])]++] = static_cast<int>(i);
  }
}

std::vector<int> Visibility::Near(const Vector2d& p, double radius_m) const {
  const double reach = radius_m + reach_m_;
  const auto clamped = [](double value, int count) {
    return static_cast<int>(std::clamp(value, 0.0, count - 1.0));
  };
  const Vector2d low = (p - corner_).array() - reach, high = (p - corner_).array() + reach;
  std::vector<int> found;
  for (int row = clamped(low.y() / cell_m_, rows_); row <= clamped(high.y() / cell_m_, rows_);
       ++row) {
    for (int column = clamped(low.x() / cell_m_, columns_);
         column <= clamped(high.x() / cell_m_, columns_); ++column) {
      const int cell = row * columns_ + column;
      for (int k = cell_begin_[cell]; k < cell_begin_[cell + 1]; ++k) {
        const Wall& wall = walls_[cell_walls_[k]];
        const Vector2d least = wall.a.cwiseMin(wall.b), most = wall.a.cwiseMax(wall.b);
        const Vector2d nearest = p.cwiseMax(least).cwiseMin(most);
        if ((nearest - p).squaredNorm() < radius_m * radius_m) found.push_back(cell_walls_[k]);
      }
    }
  }
  return found;
}

std::vector<SeenFacade> Visibility::From(const Vector2d& p, double radius_m) const {
  std::vector<Wall> facing;
  for (const int wall : Near(p, radius_m)) {
    if (internal::IsInFrontOf(walls_[wall], p)) facing.push_back(walls_[wall]);
  }
  const std::vector<internal::SeenPiece> pieces = internal::Sweep(facing, p);

  std::vector<std::pair<int, Interval>> parts;
  for (const internal::SeenPiece& piece : pieces) {
    const Wall& wall = facing[piece.wall];
    if (wall.facade < 0) continue;
    const auto reachable = WithinRadius(wall, p, radius_m);
    if (!reachable) continue;
    if (const auto seen = Intersection(piece.along_m, *reachable)) {
      parts.emplace_back(wall.facade, *seen);
    }
  }
  std::stable_sort(parts.begin(), parts.end(),
                   [](const auto& a, const auto& b) { return a.first < b.first; });
  std::vector<SeenFacade> result;
  for (const auto& [facade, part] : parts) {
    if (result.empty() || result.back().facade != facade) result.push_back({facade, {}});
    result.back().seen.push_back(part);
  }
  for (SeenFacade& facade : result) facade.seen = Union(std::move(facade.seen));
  return result;
}

double Visibility::FirstHit(const Vector2d& p, const Vector2d& direction, double reach_m) const {
  double nearest = reach_m;
  for (const int index : Near(p + direction * (reach_m / 2), reach_m / 2 + 1e-6)) {
    const Wall& wall = walls_[index];
    const Vector2d along = wall.b - wall.a;
    const double turn = Cross(direction, along);
    if (!(turn < 0)) continue;  // comes from behind, or is parallel
    const double at = Cross(wall.a - p, along) / turn;
    const double on_wall = Cross(wall.a - p, direction) / turn;
    if (at > 0 && at < nearest && on_wall >= 0 && on_wall <= 1) nearest = at;
  }
  return nearest;
}

}  // namespace stucco::plan
