// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "site/facade_views.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "site/incidence.h"

namespace stucco {
namespace {

const double kLeastCosine = std::cos(kMaxIncidence_rad);

}  // namespace

FacadeViews::FacadeViews(const Site& site, std::vector<Eigen::Vector3d> positions, double reach_m,
                         PicturesOf pictures_of)
    : site_(site),
      positions_(std::move(positions)),
      reach_m_(reach_m),
      pictures_of_(std::move(pictures_of)),
      model_(site),
      by_x_(positions_.size()) {
  for (const Facade& facade : site.facades) grids_.emplace_back(facade);
  std::iota(by_x_.begin(), by_x_.end(), 0);
  std::ranges::stable_sort(by_x_, {}, [&](int i) { return positions_[i].x(); });
}

std::vector<uint32_t> FacadeViews::AllCells(int facade) const {
  std::vector<uint32_t> cells(grids_[facade].size());
  std::iota(cells.begin(), cells.end(), 0U);
  return cells;
}

std::vector<SeenView> FacadeViews::Of(int facade) const {
  return Of(facade, AllCells(facade));
}

std::vector<int> FacadeViews::PlacesNear(int facade) const {
  const Facade& wall = site_.facades[facade];
  const auto x = [&](int i) { return positions_[i].x(); };
  const auto first =
      std::ranges::lower_bound(by_x_, std::min(wall.a.x(), wall.b.x()) - reach_m_, {}, x);
  const auto last =
      std::ranges::upper_bound(by_x_, std::max(wall.a.x(), wall.b.x()) + reach_m_, {}, x);
  std::vector<int> near(first, last);
  std::ranges::sort(near);
  return near;
}

std::vector<SeenView> FacadeViews::Of(int facade, std::span<const uint32_t> cells) const {
  std::vector<SeenView> out;
  for (const int place : PlacesNear(facade)) AddViewsFrom(place, facade, cells, out);
  return out;
}

std::vector<uint32_t> FacadeViews::Unseen(int facade) const {
  std::vector<uint32_t> cells = AllCells(facade);
  for (const int place : PlacesNear(facade)) {
    std::vector<SeenView> views;
    AddViewsFrom(place, facade, cells, views);
    for (const SeenView& view : views) {
      std::erase_if(cells,
                    [&](uint32_t cell) { return std::ranges::binary_search(view.cells, cell); });
    }
    if (cells.empty()) break;
  }
  return cells;
}

void FacadeViews::AddViewsFrom(int place, int facade, std::span<const uint32_t> cells,
                               std::vector<SeenView>& views) const {
  const FacadeGrid& grid = grids_[facade];
  const Eigen::Vector3d& p = positions_[place];
  const Eigen::Vector2d offset = p.head<2>() - grid.a;
  const double before = offset.dot(site_.facades[facade].normal());  // distance from the plane
  if (!(before > 0)) return;
  const double reach = std::min(reach_m_, before / kLeastCosine);
  // Distance to the nearest point of the wall: along it, before it, in height.
  const double u = offset.dot(grid.along);
  const Eigen::Vector3d nearest(u - std::clamp(u, 0.0, grid.length_m), before,
                                p.z() - std::clamp(p.z(), grid.z_m.from_m, grid.z_m.to_m));
  if (nearest.norm() > reach) return;

  enum : uint8_t { kNotAsked, kFree, kBlocked };
  std::vector<uint8_t> sight(grid.size(), kNotAsked);
  const std::vector<Frustum> pictures = pictures_of_(place).pictures;
  for (size_t k = 0; k < pictures.size(); ++k) {
    Frustum picture = pictures[k];
    picture.reach_m = reach;
    SeenView view{place, static_cast<int>(k), picture.forward, {}};
    for (const uint32_t cell : cells) {
      const Eigen::Vector3d center = grid.Center(cell);
      if (!picture.Contains(center)) continue;
      if (sight[cell] == kNotAsked) sight[cell] = model_.Sees(p, center) ? kFree : kBlocked;
      if (sight[cell] == kFree) view.cells.push_back(cell);
    }
    if (!view.cells.empty()) views.push_back(std::move(view));
  }
}

}  // namespace stucco
