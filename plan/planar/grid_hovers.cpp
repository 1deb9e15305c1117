// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/grid_hovers.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>

#include "plan/space/obstacles.h"
#include "site/grid_cells.h"
#include "survey/error.h"
#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

constexpr double kTilt_rad = std::numbers::pi / 4;
// Ten times the largest survey this is made for; more would fill the memory.
constexpr double kMostHovers = 300000;

// Photos of flat ground that overlap by less are matched badly.
constexpr double kLeastOverlap = 0.6;
constexpr int kMostFiner = 8;

struct Frame {
  Eigen::Vector2d u, v;       // along and across the flight lines
  Eigen::Vector2d low, size;  // of the area in them
};

// The places of the grid, from (x0, y0) in the frame on.
struct Lattice {
  Frame frame;
  double x0 = 0;
  double y0 = 0;
  GridStep step;
  int columns = 0;
  int lines = 0;

  Eigen::Vector2d At(double column, double line) const {
    return (x0 + column * step.forward_m) * frame.u + (y0 + line * step.side_m) * frame.v;
  }
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

void CheckSize(double hovers, const Eigen::Vector2d& size, const GridStep& step) {
  if (hovers <= kMostHovers) return;
  throw Error(ErrorKind::kBadInput,
              fmt::format("a grid of {:.1f} m by {:.1f} m over {:.0f} m by {:.0f} m has {:.0f} "
                          "hovering points",
                          step.forward_m, step.side_m, size.x(), size.y(), hovers),
              "plan a smaller area of interest, fly higher, or ask for less overlap");
}

Lattice LatticeOf(const Site& site, const CameraPreset& camera, const GridOptions& options) {
  const GridStep step = StepOf(site, camera, options);
  const Frame frame = FrameOf(site.area);
  CheckSize((frame.size.x() / step.forward_m + 1) * (frame.size.y() / step.side_m + 1), frame.size,
            step);
  Lattice out{.frame = frame,
              .step = step,
              .columns = static_cast<int>(frame.size.x() / step.forward_m) + 1,
              .lines = static_cast<int>(frame.size.y() / step.side_m) + 1};
  // What the area is wider than the grid is left at both sides alike.
  out.x0 = frame.low.x() + 0.5 * (frame.size.x() - (out.columns - 1) * step.forward_m);
  out.y0 = frame.low.y() + 0.5 * (frame.size.y() - (out.lines - 1) * step.side_m);
  return out;
}

bool HasArea(const Site& site) {
  return !site.area.rings.empty() && site.area.rings.front().size() >= 3;
}

// Below the ceiling.
double DepthOf(const Site& site, const Footprint& footprint) {
  return site.CeilingAt(footprint.outline.rings.front().front()) - footprint.z_m.to_m;
}

// Places of the lattice, in eighths of its steps.
using Places = std::set<std::pair<int, int>>;

// Those from which the footprint is seen steeply enough, at `finer` to a step.
void AddPlacesAbove(const Site& site, const Footprint& footprint, const Lattice& lattice, int finer,
                    Places& places) {
  const double reach = DepthOf(site, footprint);
  const Eigen::Array2d step(lattice.step.forward_m, lattice.step.side_m);
  Eigen::AlignedBox2d box;
  for (const Eigen::Vector2d& corner : footprint.outline.rings.front()) {
    box.extend(Eigen::Vector2d(corner.dot(lattice.frame.u) - lattice.x0,
                               corner.dot(lattice.frame.v) - lattice.y0));
  }
  const Eigen::Array2d low = finer * (box.min().array() - reach) / step;
  const Eigen::Array2d high = finer * (box.max().array() + reach) / step;
  const int eighths = kMostFiner / finer;
  for (int line = static_cast<int>(std::ceil(low.y())); line <= high.y(); ++line) {
    for (int column = static_cast<int>(std::ceil(low.x())); column <= high.x(); ++column) {
      const Eigen::Vector2d at =
          lattice.At(static_cast<double>(column) / finer, static_cast<double>(line) / finer);
      if (Contains(footprint.outline, at) || Distance(footprint.outline, at) <= reach) {
        places.emplace(line * eighths, column * eighths);
      }
    }
  }
}

bool IsOfGrid(const std::pair<int, int>& place, const Lattice& lattice) {
  const auto is_one_of = [](int eighths, int count) {
    return eighths % kMostFiner == 0 && eighths >= 0 && eighths < count * kMostFiner;
  };
  return is_one_of(place.first, lattice.lines) && is_one_of(place.second, lattice.columns);
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
  if (!HasArea(site)) return out;
  const Lattice lattice = LatticeOf(site, camera, options);
  const Obstacles obstacles(site);
  const std::vector<Shot> shots = FiveShots(std::atan2(lattice.frame.u.x(), lattice.frame.u.y()));
  for (int line = 0; line < lattice.lines; ++line) {
    for (int i = 0; i < lattice.columns; ++i) {
      const Eigen::Vector2d at = lattice.At(line % 2 == 0 ? i : lattice.columns - 1 - i, line);
      const Eigen::Vector3d position(at.x(), at.y(), site.CeilingAt(at));
      if (Contains(site.area, at) && obstacles.IsFree(position)) out.push_back({position, shots});
    }
  }
  return out;
}

int FinerAbove(const Site& site, const Footprint& footprint, const GridOptions& options) {
  if (!footprint.top_known || footprint.outline.rings.empty()) return 1;
  const double depth = std::max(DepthOf(site, footprint), 0.5 * site.d_min_m);
  const double overlap = std::min(options.forward_overlap, options.side_overlap);
  // Of the frame there, from one hover to the next.
  const double step = (1 - overlap) * site.safe_altitude_m / depth;
  const double most = std::max(1 - kLeastOverlap, 1 - overlap);
  int finer = 1;
  while (finer < kMostFiner && step > most * finer) finer *= 2;
  return finer;
}

std::vector<Hover> HoversAboveHighRoofs(const Site& site, const CameraPreset& camera,
                                        const GridOptions& options) {
  std::vector<Hover> out;
  if (!HasArea(site)) return out;
  const Lattice lattice = LatticeOf(site, camera, options);
  Places places;
  for (const Footprint& footprint : site.footprints) {
    if (!footprint.in_area) continue;
    const int finer = FinerAbove(site, footprint, options);
    if (finer > 1) AddPlacesAbove(site, footprint, lattice, finer, places);
  }
  CheckSize(static_cast<double>(places.size()), lattice.frame.size, lattice.step);
  const Obstacles obstacles(site);
  const std::vector<Shot> shots = FiveShots(std::atan2(lattice.frame.u.x(), lattice.frame.u.y()));
  for (const std::pair<int, int>& place : places) {
    if (IsOfGrid(place, lattice)) continue;
    const Eigen::Vector2d at = lattice.At(static_cast<double>(place.second) / kMostFiner,
                                          static_cast<double>(place.first) / kMostFiner);
    const Eigen::Vector3d position(at.x(), at.y(), site.CeilingAt(at));
    if (Contains(site.area, at) && obstacles.IsFree(position)) out.push_back({position, shots});
  }
  return out;
}

}  // namespace stucco::plan
