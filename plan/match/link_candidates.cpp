// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/match/link_candidates.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "plan/match/match_graph.h"

namespace stucco::plan {
namespace {

using Eigen::Vector3d;

constexpr double kRadians = std::numbers::pi / 180;
// Multiples of the photo's distance; two such steps span what lies between a facade photo and one
// from above.
constexpr double kSteps[] = {1.25, 1.6, 2.0, 2.35};
// Up, and aside where something stands in the way.
constexpr double kRises_deg[] = {8, 16, 24, 31};
constexpr double kTurns_deg[] = {0, 22, -22};
// Beside a photo above which nothing is free, as above one at the height of flight: at its height.
constexpr double kAside_deg[] = {12, 22, 30};
constexpr int kWaysAside = 8;
// The middle of what a photo shows is no point that all of it is seen from under one angle.
constexpr double kSpare = 0.95;
// Gimbals tilt down to straight below and up by 20 to 35 degrees.
constexpr double kSteepest = -89 * kRadians;
constexpr double kHighest = 20 * kRadians;
// A place nearer to the photo shows what it shows from where it does.
constexpr double kApart_m = 2;
// Sights are in single precision.
constexpr double kRounding_m = 1e-3;
// Photos that a stop in passing costs, and one that the drone makes for it.
constexpr double kColumnCost = 2.5;
constexpr double kStopCost = 3;

Vector3d Risen(const Vector3d& way, double rise_rad, double turn_rad) {
  const double elevation =
      std::min(std::asin(std::clamp(way.z(), -1.0, 1.0)) + rise_rad, std::numbers::pi / 2);
  const double azimuth = std::atan2(way.y(), way.x()) + turn_rad;
  return {std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
          std::sin(elevation)};
}

class Finder {
 public:
  Finder(const Gaze& gaze, const Obstacles& obstacles) : gaze_(gaze), obstacles_(obstacles) {}

  bool IsClose(const Vector3d& position) const {
    const Vector3d ray = position - gaze_.middle;
    const double ratio = ray.norm() / gaze_.distance_m;
    return std::max(ratio, 1 / ratio) <= kSpare * kCloseRatio &&
           ray.normalized().dot(gaze_.way) >= std::cos(kSpare * kCloseAngle_rad) &&
           (position - gaze_.middle - gaze_.distance_m * gaze_.way).norm() > kApart_m;
  }
  void Take(const Vector3d& position, LinkPlace place, int hover) {
    found_.push_back({position, LinkShot(gaze_.middle - position), place, hover});
  }
  // Returns whether it is.
  bool TakeIfFree(Vector3d position, LinkPlace place, int hover) {
    const double ceiling = obstacles_.site().CeilingAt(position.head<2>());
    if (std::abs(position.z() - ceiling) < kRounding_m) position.z() = ceiling;
    if (position.z() > ceiling) return false;
    if (!IsClose(position) || !obstacles_.IsFree(position)) return false;
    Take(position, place, hover);
    return true;
  }
  std::vector<LinkCandidate> TakeFound() { return std::move(found_); }

 private:
  std::vector<LinkCandidate> found_;
  const Gaze& gaze_;
  const Obstacles& obstacles_;
};

}  // namespace

double LinkCost(LinkPlace place) {
  if (place == LinkPlace::kHover) return 1;
  return 1 + (place == LinkPlace::kColumn ? kColumnCost : kStopCost);
}

Shot LinkShot(const Vector3d& way) {
  const Vector3d ray = way.normalized();
  return {.yaw_rad = std::atan2(ray.x(), ray.y()),
          .pitch_rad = std::clamp(std::asin(std::clamp(ray.z(), -1.0, 1.0)), kSteepest, kHighest),
          .kind = ViewKind::kLink,
          .targets = {}};
}

Gaze GazeOf(const SurfaceView& view, std::span<const Sight> sights, bool walls_only) {
  Gaze out;
  Vector3d middle = Vector3d::Zero(), camera = Vector3d::Zero();
  double shares = 0;
  for (const Sight& sight : sights) {
    const SurfaceSample& sample = view.samples[sight.sample];
    if (walls_only && sample.kind != SurfaceKind::kWall) continue;
    middle += sight.share * sample.position;
    camera = sample.position + sight.distance_m * sight.way.cast<double>();
    shares += sight.share;
  }
  if (!(shares > 0)) return out;
  out.middle = middle / shares;
  out.distance_m = (camera - out.middle).norm();
  out.way = (camera - out.middle) / out.distance_m;
  return out;
}

std::vector<LinkCandidate> LinkCandidates(const Gaze& gaze, const Obstacles& obstacles,
                                          std::span<const Hover> hovers, int own_hover) {
  if (!(gaze.distance_m > 0)) return {};
  Finder finder(gaze, obstacles);
  for (size_t h = 0; h < hovers.size(); ++h) {
    if (finder.IsClose(hovers[h].position)) {
      finder.Take(hovers[h].position, LinkPlace::kHover, static_cast<int>(h));
    }
  }
  const Vector3d own = gaze.middle + gaze.distance_m * gaze.way;
  for (double rise = kApart_m + 0.5; rise < gaze.distance_m; rise *= 1.3) {
    finder.TakeIfFree(own + rise * Vector3d::UnitZ(), LinkPlace::kColumn, own_hover);
  }
  bool any_above = false;
  for (const double step : kSteps) {
    for (const double rise : kRises_deg) {
      for (const double turn : kTurns_deg) {
        const Vector3d way = Risen(gaze.way, rise * kRadians, turn * kRadians);
        any_above |=
            finder.TakeIfFree(gaze.middle + step * gaze.distance_m * way, LinkPlace::kOwn, -1);
      }
    }
  }
  for (int i = 0; !any_above && i < kWaysAside; ++i) {
    const double around = 2 * std::numbers::pi * i / kWaysAside;
    const Vector3d aside(std::cos(around), std::sin(around), 0);
    for (const double angle : kAside_deg) {
      finder.TakeIfFree(own + gaze.distance_m * std::tan(angle * kRadians) * aside, LinkPlace::kOwn,
                        -1);
    }
  }
  return finder.TakeFound();
}

}  // namespace stucco::plan
