// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/facade_views.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numbers>
#include <numeric>

#include "plan/model/frustum.h"

namespace stucco::plan {
namespace {

constexpr double kCell_m = 1;
constexpr int kFewestColumns = 3;
constexpr int kFewestRows = 2;
constexpr double kMostCells = 400;
const double kLeastCosine = std::cos(75 * std::numbers::pi / 180);

}  // namespace

FacadeGrid::FacadeGrid(const Facade& facade)
    : a(facade.a), along(facade.along()), length_m(facade.length_m()), z_m(facade.z_m) {
  const double height = z_m.length_m();
  const double size = std::max(kCell_m, std::sqrt(length_m * height / kMostCells));
  columns = std::max(kFewestColumns, static_cast<int>(std::lround(length_m / size)));
  rows = std::max(kFewestRows, static_cast<int>(std::lround(height / size)));
}

Interval FacadeGrid::Along(uint32_t cell) const {
  const double step = length_m / columns;
  const int column = static_cast<int>(cell) % columns;
  return {column * step, (column + 1) * step};
}

Interval FacadeGrid::Heights(uint32_t cell) const {
  const double step = z_m.length_m() / rows;
  const int row = static_cast<int>(cell) / columns;
  return {z_m.from_m + row * step, z_m.from_m + (row + 1) * step};
}

Eigen::Vector3d FacadeGrid::Center(uint32_t cell) const {
  const Interval u = Along(cell);
  const Interval v = Heights(cell);
  const Eigen::Vector2d at = a + 0.5 * (u.from_m + u.to_m) * along;
  return {at.x(), at.y(), 0.5 * (v.from_m + v.to_m)};
}

FacadeSight::FacadeSight(const Site& site, const CameraPreset& camera, double d_max_m,
                         std::span<const Hover> hovers)
    : site_(site),
      camera_(camera),
      d_max_m_(d_max_m),
      hovers_(hovers),
      model_(site),
      by_x_(hovers.size()) {
  for (const Facade& facade : site.facades) grids_.emplace_back(facade);
  std::iota(by_x_.begin(), by_x_.end(), 0);
  std::ranges::stable_sort(by_x_, {}, [&](int i) { return hovers_[i].position.x(); });
}

std::vector<SeenView> FacadeSight::ViewsOf(int facade) const {
  std::vector<uint32_t> cells(grids_[facade].size());
  std::iota(cells.begin(), cells.end(), 0U);
  return ViewsOf(facade, cells);
}

std::vector<SeenView> FacadeSight::ViewsOf(int facade, std::span<const uint32_t> cells) const {
  const Facade& wall = site_.facades[facade];
  const auto x = [&](int i) { return hovers_[i].position.x(); };
  const auto first =
      std::ranges::lower_bound(by_x_, std::min(wall.a.x(), wall.b.x()) - d_max_m_, {}, x);
  const auto last =
      std::ranges::upper_bound(by_x_, std::max(wall.a.x(), wall.b.x()) + d_max_m_, {}, x);
  std::vector<int> near(first, last);
  std::ranges::sort(near);
  std::vector<SeenView> out;
  for (const int hover : near) AddViewsFrom(hover, facade, cells, out);
  return out;
}

void FacadeSight::AddViewsFrom(int hover, int facade, std::span<const uint32_t> cells,
                               std::vector<SeenView>& views) const {
  const FacadeGrid& grid = grids_[facade];
  const Eigen::Vector3d& p = hovers_[hover].position;
  const Eigen::Vector2d offset = p.head<2>() - grid.a;
  const double before = offset.dot(site_.facades[facade].normal());  // distance from the plane
  if (!(before > 0)) return;
  const double reach = std::min(d_max_m_, before / kLeastCosine);
  // Distance to the nearest point of the wall: along it, before it, in height.
  const double u = offset.dot(grid.along);
  const Eigen::Vector3d nearest(u - std::clamp(u, 0.0, grid.length_m), before,
                                p.z() - std::clamp(p.z(), grid.z_m.from_m, grid.z_m.to_m));
  if (nearest.norm() > reach) return;

  enum : uint8_t { kNotAsked, kFree, kBlocked };
  std::vector<uint8_t> sight(grid.size(), kNotAsked);
  for (size_t k = 0; k < hovers_[hover].shots.size(); ++k) {
    const Frustum frustum = FrustumOf(camera_, p, hovers_[hover].shots[k], reach);
    SeenView view{hover, static_cast<int>(k), frustum.forward, {}};
    for (const uint32_t cell : cells) {
      const Eigen::Vector3d center = grid.Center(cell);
      if (!frustum.Contains(center)) continue;
      if (sight[cell] == kNotAsked) sight[cell] = model_.Sees(p, center) ? kFree : kBlocked;
      if (sight[cell] == kFree) view.cells.push_back(cell);
    }
    if (!view.cells.empty()) views.push_back(std::move(view));
  }
}

SeenPart FacadeSight::PartOf(int facade, const SeenView& view,
                             std::span<const uint32_t> cells) const {
  const FacadeGrid& grid = grids_[facade];
  const Eigen::Vector2d normal = site_.facades[facade].normal();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const uint32_t cell : cells) sum += grid.Center(cell);
  SeenPart out;
  out.direction = view.direction;
  out.frontality = -view.direction.head<2>().dot(normal);
  if (cells.empty()) return out;
  const auto count = static_cast<double>(cells.size());
  out.share = count / static_cast<double>(grid.size());
  out.distance_m = (hovers_[view.hover].position - sum / count).norm();
  return out;
}

double FacadeSight::ScoreOf(int facade, const SeenPart& part) const {
  const FacadeGrid& grid = grids_[facade];
  const double widest =
      std::min(1.0, camera_.WidthAt(part.distance_m) / std::max(grid.length_m, 1e-9)) *
      std::min(1.0, camera_.HeightAt(part.distance_m) / std::max(grid.z_m.length_m(), 1e-9));
  if (!(widest > 0)) return 0;
  return ViewScore(QualityOfView(part, widest, site_.d_min_m, d_max_m_));
}

Target BoxAround(const FacadeGrid& grid, int facade, std::span<const uint32_t> cells) {
  assert(!cells.empty());
  Target out{facade, grid.Along(cells.front()), grid.Heights(cells.front())};
  for (const uint32_t cell : cells) {
    const Interval u = grid.Along(cell);
    const Interval v = grid.Heights(cell);
    out.along_m = {std::min(out.along_m.from_m, u.from_m), std::max(out.along_m.to_m, u.to_m)};
    out.z_m = {std::min(out.z_m.from_m, v.from_m), std::max(out.z_m.to_m, v.to_m)};
  }
  return out;
}

}  // namespace stucco::plan
