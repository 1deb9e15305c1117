// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "simulate/render/internal/view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "survey/parallel.h"

namespace stucco::simulate::internal {
namespace {

constexpr int kWidestSpacing = 16;
constexpr double kTolerancePx = 1e-3;
constexpr size_t kTablesKept = 4;

Eigen::Vector2d UnprojectOrNan(const Camera& camera, double x, double y) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  return camera.Unproject({x, y}).value_or(Eigen::Vector2d(kNan, kNan));
}

// The largest error, in pixels, that linear interpolation makes in the middle of cells. Cells at
// the rim of what the lens shows do not count: they are not interpolated.
double WorstError(const Camera& camera, int spacing, int columns,
                  const std::vector<Eigen::Vector2d>& nodes) {
  const int rows = static_cast<int>(nodes.size()) / columns;
  double worst = 0;
  for (int r = 0; r + 1 < rows; ++r) {
    for (int c = 0; c + 1 < columns; ++c) {
      const size_t i = static_cast<size_t>(r) * columns + c;
      const Eigen::Vector2d between =
          (nodes[i] + nodes[i + 1] + nodes[i + columns] + nodes[i + columns + 1]) / 4;
      const Eigen::Vector2d exact =
          UnprojectOrNan(camera, (c + 0.5) * spacing, (r + 0.5) * spacing);
      const Eigen::Vector2d error = between - exact;
      if (!error.allFinite()) continue;
      worst = std::max(
          {worst, std::abs(error.x()) * camera.FocalX(), std::abs(error.y()) * camera.FocalY()});
    }
  }
  return worst;
}

}  // namespace

LensTable::LensTable(const Camera& camera) : camera_(camera) {
  for (spacing_px_ = kWidestSpacing;; spacing_px_ /= 2) {
    columns_ = (camera.width_px + spacing_px_ - 1) / spacing_px_ + 1;
    const int rows = (camera.height_px + spacing_px_ - 1) / spacing_px_ + 1;
    nodes_.resize(static_cast<size_t>(columns_) * rows);
    ParallelFor(rows, std::numeric_limits<int>::max(), [&](size_t r) {
      for (int c = 0; c < columns_; ++c) {
        nodes_[r * columns_ + c] =
            UnprojectOrNan(camera, c * spacing_px_, static_cast<double>(r) * spacing_px_);
      }
    });
    if (spacing_px_ == 1 || WorstError(camera, spacing_px_, columns_, nodes_) < kTolerancePx) {
      return;
    }
  }
}

LensTable::Cell LensTable::CellAt(double x, double y) const {
  const double gx = x / spacing_px_;
  const double gy = y / spacing_px_;
  const int rows = static_cast<int>(nodes_.size()) / columns_;
  const int c = std::clamp(static_cast<int>(gx), 0, columns_ - 2);
  const int r = std::clamp(static_cast<int>(gy), 0, rows - 2);
  return {&nodes_[static_cast<size_t>(r) * columns_ + c], gx - c, gy - r};
}

Eigen::Vector2d LensTable::At(double x, double y) const {
  const Cell cell = CellAt(x, y);
  const Eigen::Vector2d* upper = cell.node;
  const Eigen::Vector2d* lower = upper + columns_;
  const Eigen::Vector2d left = upper[0] + cell.tx * (upper[1] - upper[0]);
  const Eigen::Vector2d below = lower[0] + cell.tx * (lower[1] - lower[0]);
  const Eigen::Vector2d at = left + cell.ty * (below - left);
  return at.allFinite() ? at : UnprojectOrNan(camera_, x, y);
}

LensTable::Slopes LensTable::SlopesAt(double x, double y) const {
  const Cell cell = CellAt(x, y);
  const Eigen::Vector2d* upper = cell.node;
  const Eigen::Vector2d* lower = upper + columns_;
  const Eigen::Vector2d top = upper[1] - upper[0];
  const Eigen::Vector2d bottom = lower[1] - lower[0];
  const Eigen::Vector2d down = lower[0] + cell.tx * bottom - (upper[0] + cell.tx * top);
  if (!down.allFinite()) return {{1 / camera_.FocalX(), 0}, {0, 1 / camera_.FocalY()}};
  return {(top + cell.ty * (bottom - top)) / spacing_px_, down / spacing_px_};
}

bool LensTable::IsOf(const Camera& camera) const {
  return camera_.model == camera.model && camera_.width_px == camera.width_px &&
         camera_.height_px == camera.height_px && camera_.params == camera.params;
}

std::shared_ptr<const LensTable> LensTables::For(const Camera& camera) {
  {
    const std::lock_guard lock(mutex_);
    for (const auto& table : tables_) {
      if (table->IsOf(camera)) return table;
    }
  }
  // Built outside the lock: two threads may build the same table, which is only slow.
  auto made = std::make_shared<const LensTable>(camera);
  const std::lock_guard lock(mutex_);
  if (tables_.size() >= kTablesKept) tables_.erase(tables_.begin());
  tables_.push_back(made);
  return made;
}

View ViewOf(std::shared_ptr<const LensTable> lens, const Camera& camera,
            const Pose& cam_from_world) {
  View view;
  view.width_px = camera.width_px;
  view.height_px = camera.height_px;
  view.origin = cam_from_world.Center();
  view.world_from_cam = cam_from_world.rotation.conjugate().toRotationMatrix().cast<float>();
  view.direction = view.world_from_cam.col(2);
  view.lens = std::move(lens);
  return view;
}

View ViewOf(const PicturePlane& plane) {
  View view;
  view.width_px = plane.width_px;
  view.height_px = plane.height_px;
  const Eigen::Vector3d normal = plane.v_axis.cross(plane.u_axis).normalized();
  view.origin = plane.origin + plane.from_m * normal;
  view.origin_right = plane.metres_per_texel * plane.u_axis;
  view.origin_down = plane.metres_per_texel * plane.v_axis;
  view.direction = -normal.cast<float>();
  view.to = plane.from_m + plane.to_m;
  return view;
}

bool RayAt(const View& view, double x, double y, Ray& ray) {
  ray.origin = (view.origin + x * view.origin_right + y * view.origin_down).cast<float>();
  ray.to = static_cast<float>(view.to);
  ray.direction = view.direction;
  if (!view.lens) return true;
  const Eigen::Vector2d at = view.lens->At(x, y);
  if (!at.allFinite()) return false;
  ray.direction = view.world_from_cam * at.homogeneous().cast<float>();
  return true;
}

ViewRay ViewRayOf(const View& view, double x, double y, const Ray& ray) {
  ViewRay out;
  out.ray = ray;
  out.origin_right = view.origin_right.cast<float>();
  out.origin_down = view.origin_down.cast<float>();
  out.direction_right = out.direction_down = Eigen::Vector3f::Zero();
  if (!view.lens) return out;
  const LensTable::Slopes slopes = view.lens->SlopesAt(x, y);
  out.direction_right = view.world_from_cam.leftCols<2>() * slopes.right.cast<float>();
  out.direction_down = view.world_from_cam.leftCols<2>() * slopes.down.cast<float>();
  return out;
}

}  // namespace stucco::simulate::internal
