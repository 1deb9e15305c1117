// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/evaluate/facade_sight.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace stucco::plan {
namespace {

std::vector<Eigen::Vector3d> PositionsOf(std::span<const Hover> hovers) {
  std::vector<Eigen::Vector3d> out;
  out.reserve(hovers.size());
  for (const Hover& hover : hovers) out.push_back(hover.position);
  return out;
}

}  // namespace

FacadeSight::FacadeSight(const Site& site, const CameraPreset& camera, double d_max_m,
                         std::span<const Hover> hovers)
    : site_(site),
      camera_(camera),
      d_max_m_(d_max_m),
      hovers_(hovers),
      views_(site, PositionsOf(hovers), d_max_m, [field = camera.Field(), hovers, d_max_m](int i) {
        return ViewpointOf(field, hovers[i], d_max_m);
      }) {}

SeenPart FacadeSight::PartOf(int facade, const SeenView& view,
                             std::span<const uint32_t> cells) const {
  const FacadeGrid& facade_grid = grid(facade);
  const Eigen::Vector2d normal = site_.facades[facade].normal();
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const uint32_t cell : cells) sum += facade_grid.Center(cell);
  SeenPart out;
  out.direction = view.direction;
  out.frontality = -view.direction.head<2>().dot(normal);
  if (cells.empty()) return out;
  const auto count = static_cast<double>(cells.size());
  out.share = count / static_cast<double>(facade_grid.size());
  out.distance_m = (hovers_[view.place].position - sum / count).norm();
  return out;
}

double FacadeSight::ScoreOf(int facade, const SeenPart& part) const {
  const FacadeGrid& facade_grid = grid(facade);
  const double widest =
      std::min(1.0, camera_.WidthAt(part.distance_m) / std::max(facade_grid.length_m, 1e-9)) *
      std::min(1.0, camera_.HeightAt(part.distance_m) / std::max(facade_grid.z_m.length_m(), 1e-9));
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
