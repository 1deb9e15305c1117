// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/grid_hovers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "plan/model/cells.h"
#include "plan/space/obstacles.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr double kTilt_rad = std::numbers::pi / 4;
// Ten times the largest survey this is made for; more would fill the memory.
constexpr double kMostHovers = 300000;

struct Frame {
  Eigen::Vector2d u, v;       // along and across the flight lines
  Eigen::Vector2d low, size;  // of the area in them
};

Frame FrameOf(const Polygon& area) {
  const Eigen::Vector2d u = MainAxis(area);
  Frame out{u, {-u.y(), u.x()}, {}, {}};
  Eigen::Vector2d low = Eigen::Vector2d::Constant(std::numeric_limits<double>::max());
  Eigen::Vector2d high = -low;
  for (const Eigen::Vector2d& corner : area.rings.front()) {
    const Eigen::Vector2d at(corner.dot(out.u), corner.dot(out.v));
    low = low.cwiseMin(at);
    high = high.cwiseMax(at);
  }
  out.low = low;
  out.size = high - low;
  return out;
}

void CheckSize(const Eigen::Vector2d& size, const GridStep& step) {
  const double hovers = (size.x() / step.forward_m + 1) * (size.y() / step.side_m + 1);
  if (hovers <= kMostHovers) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("a grid of {:.1f} m by {:.1f} m over {:.0f} m by {:.0f} m has {:.0f} "
                          "hovering points",
                          step.forward_m, step.side_m, size.x(), size.y(), hovers),
              "plan a smaller area of interest, fly higher, or ask for less overlap");
}

}  // namespace

GridStep StepOf(const Site& site, const CameraPreset& camera, const GridOptions& options) {
  return {.forward_m = (1 - options.forward_overlap) * camera.HeightAt(site.safe_altitude_m),
          .side_m = (1 - options.side_overlap) * camera.WidthAt(site.safe_altitude_m)};
}

std::vector<Shot> FiveShots(double yaw_rad) {
  std::vector<Shot> out{{.yaw_rad = yaw_rad,
                         .pitch_rad = -std::numbers::pi / 2,
                         .kind = ViewKind::kNadir,
                         .targets = {}}};
  for (int turn = 0; turn < 4; ++turn) {
    const double yaw = std::remainder(yaw_rad + turn * std::numbers::pi / 2, 2 * std::numbers::pi);
    out.push_back(
        {.yaw_rad = yaw, .pitch_rad = -kTilt_rad, .kind = ViewKind::kOblique, .targets = {}});
  }
  return out;
}

std::vector<Hover> GridHovers(const Site& site, const CameraPreset& camera,
                              const GridOptions& options) {
  std::vector<Hover> out;
  if (site.area.rings.empty() || site.area.rings.front().size() < 3) return out;
  const GridStep step = StepOf(site, camera, options);
  const Frame frame = FrameOf(site.area);
  CheckSize(frame.size, step);
  const Obstacles obstacles(site);
  const int columns = static_cast<int>(frame.size.x() / step.forward_m) + 1;
  const int lines = static_cast<int>(frame.size.y() / step.side_m) + 1;
  // What the area is wider than the grid is left at both sides alike.
  const double x0 = frame.low.x() + 0.5 * (frame.size.x() - (columns - 1) * step.forward_m);
  const double y0 = frame.low.y() + 0.5 * (frame.size.y() - (lines - 1) * step.side_m);
  const std::vector<Shot> shots = FiveShots(std::atan2(frame.u.x(), frame.u.y()));
  for (int line = 0; line < lines; ++line) {
    for (int i = 0; i < columns; ++i) {
      const int column = line % 2 == 0 ? i : columns - 1 - i;
      const Eigen::Vector2d at =
          (x0 + column * step.forward_m) * frame.u + (y0 + line * step.side_m) * frame.v;
      const Eigen::Vector3d position(at.x(), at.y(), site.CeilingAt(at));
      if (Contains(site.area, at) && obstacles.IsFree(position)) out.push_back({position, shots});
    }
  }
  return out;
}

}  // namespace stucco::plan
