// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/facets/plane_view.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cassert>
#include <cmath>

#include "survey/parallel.h"

namespace stucco {
namespace {

std::vector<float> DistanceToSeen(const PlaneRaster& raster,
                                  const std::vector<Evidence>& evidence) {
  if (evidence.empty()) return {};
  std::vector<char> seen(evidence.size());
  for (size_t i = 0; i < seen.size(); ++i) seen[i] = evidence[i] == Evidence::kSeen ? 1 : 0;
  return DistancesTo(raster, seen);
}

bool IsNearSeen(const PlaneView& view, const Eigen::Vector3d& point, double reach) {
  const int index = view.raster.IndexAt(view.raster.frame.ToPlane(point));
  return index >= 0 && view.to_seen[index] <= reach;
}

constexpr double kFootReach = 1.5;  // cars and hedges hide the foot of a wall

// Where along a line both planes are seen nearby: the length of it, and its ends.
struct SharedStretch {
  double length = 0;
  double from = 0, to = 0;  // from `point` on
};

SharedStretch FindShared(const PlaneView& a, const PlaneView& b, const Eigen::Vector3d& point,
                         const Eigen::Vector3d& direction, double reach) {
  const double step = std::max(a.raster.cell, b.raster.cell);
  const Eigen::Vector2d middle =
      a.raster.origin + 0.5 * a.raster.cell * Eigen::Vector2d(a.raster.width, a.raster.height);
  const double half = a.raster.cell * std::hypot(a.raster.width, a.raster.height) / 2;
  const double start = direction.dot(a.raster.frame.ToWorld(middle) - point);
  const int steps = static_cast<int>(std::ceil(half / step));
  SharedStretch shared;
  if (b.ground) reach *= kFootReach;
  for (int k = -steps; k <= steps; ++k) {
    const double t = start + k * step;
    const Eigen::Vector3d p = point + t * direction;
    if (!IsNearSeen(a, p, reach) || !(b.ground || IsNearSeen(b, p, reach))) continue;
    if (shared.length == 0) shared.from = t - step;
    shared.to = t + step;
    shared.length += step;
  }
  return shared;
}

// Whether much of what was seen of a wall lies below a line: then that is not where it meets the
// ground, but where ground somewhere else would, if it went on as it slopes.
bool Buries(const CutLine& line, const PlaneView& wall) {
  constexpr double kMost = 0.1;  // of the seen cells
  int seen = 0;
  int below = 0;
  for (int y = 0; y < wall.raster.height; ++y) {
    for (int x = 0; x < wall.raster.width; ++x) {
      if (wall.evidence[wall.raster.Index(x, y)] != Evidence::kSeen) continue;
      ++seen;
      below += line.HeightOf(wall.raster.Center(x, y)) < -wall.raster.cell;
    }
  }
  return below > kMost * seen;
}

}  // namespace

std::vector<PlaneView> ViewPlanes(const PlanarScene& scene, std::span<const Plane> planes,
                                  size_t first_ground, int threads) {
  const Samples& samples = scene.samples;
  const Tolerances& tolerances = scene.tolerances;
  const double cell = std::max(2.0 * tolerances.spacing, tolerances.level_of_detail / 3);
  const double margin = kFootReach * tolerances.fill_gap + 4 * cell;
  constexpr double kRecess = 4;  // doors and loggias less deep than this do not open a wall
  std::vector<PlaneView> views(planes.size());
  ParallelFor(planes.size(), threads, [&](size_t p) {
    const Plane& plane = planes[p];
    PlaneView& view = views[p];
    view.plane = &plane;
    view.ground = p >= first_ground;
    const PlaneFrame frame =
        FrameOf(plane, scene.up, scene.main_direction, samples.positions[plane.points.front()]);
    view.raster = RasteriseHits(samples, plane, frame, cell, margin);
    CountThroughRays(samples, scene.support, plane, kRecess * tolerances.level_of_detail,
                     view.raster);
    view.evidence = Classify(view.raster, tolerances.fill_gap, tolerances.min_area);
    if (plane.role == PlaneRole::kWall || plane.role == PlaneRole::kSlope) {
      assert(frame.v.dot(scene.up) > 0);
      FillBays(view.raster, 3 * tolerances.fill_gap, view.evidence);
    }
    view.to_seen = DistanceToSeen(view.raster, view.evidence);
  });
  return views;
}

std::vector<CutLine> Creases(const PlaneView& view, std::span<const PlaneView* const> others,
                             double reach, double min_length) {
  constexpr double kParallel = 0.17;  // sine of 10 degrees
  std::vector<CutLine> creases;
  for (const PlaneView* other : others) {
    const Plane& a = *view.plane;
    const Plane& b = *other->plane;
    const Eigen::Vector3d cross = a.normal.cross(b.normal);
    if (other == &view || cross.norm() < kParallel) continue;
    // The point of both planes nearest to the frame's origin.
    const Eigen::Vector3d origin = view.raster.frame.origin;
    const double cosine = a.normal.dot(b.normal);
    const double da = -a.DistanceTo(origin), db = -b.DistanceTo(origin);
    const double scale = 1 / (1 - cosine * cosine);
    const Eigen::Vector3d point =
        origin + (da - cosine * db) * scale * a.normal + (db - cosine * da) * scale * b.normal;
    const Eigen::Vector3d direction = cross.normalized();
    const SharedStretch shared = FindShared(view, *other, point, direction, reach);
    if (shared.length < min_length) continue;
    const CutLine line{.point = view.raster.frame.ToPlane(point),
                       .direction = Eigen::Vector2d(view.raster.frame.u.dot(direction),
                                                    view.raster.frame.v.dot(direction)),
                       .crease = true,
                       .foot = other->ground && a.role == PlaneRole::kWall,
                       .from = shared.from,
                       .to = shared.to};
    if (line.foot && Buries(line, view)) continue;
    const auto same = [&](const CutLine& c) {
      const Eigen::Vector2d d = line.point - c.point;
      return std::abs(c.direction.dot(line.direction)) > 1 - 1e-9 &&
             std::abs(c.direction.x() * d.y() - c.direction.y() * d.x()) < 1e-6 * reach;
    };
    const bool known = std::any_of(creases.begin(), creases.end(), same);
    if (!known) creases.push_back(line);
  }
  return creases;
}

}  // namespace stucco
