// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/wall_view.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "site/incidence.h"

namespace stucco::plan {
namespace {

using Eigen::Vector2d;

constexpr double kLeastPieceM = 0.05;

// Along the facade's line from a, in metres.
double FootOf(const Facade& facade, const Vector2d& p) {
  return (p - facade.a).dot(facade.along());
}

// To whole centimetres, inwards.
Interval Rounded(const Interval& window) {
  return {std::ceil(window.from_m * 100) / 100, std::floor(window.to_m * 100) / 100};
}

}  // namespace

double DistanceTo(const Facade& facade, const Vector2d& p) {
  return (p - facade.a).dot(facade.normal());
}

Vector2d Direction(const Facade& facade, double turn_rad) {
  return std::cos(turn_rad) * -facade.normal() + std::sin(turn_rad) * facade.along();
}

Interval FrontalWindow(const Facade& facade, const Vector2d& p) {
  const double foot = FootOf(facade, p);
  const double half = std::max(0.0, DistanceTo(facade, p)) * std::tan(kMaxIncidence_rad);
  return {foot - half, foot + half};
}

Interval FieldWindow(const Facade& facade, const Vector2d& p, double turn_rad, double hfov_rad) {
  const double foot = FootOf(facade, p), distance = std::max(0.0, DistanceTo(facade, p));
  const double low = std::clamp(turn_rad - hfov_rad / 2, -kMaxIncidence_rad, kMaxIncidence_rad);
  const double high = std::clamp(turn_rad + hfov_rad / 2, -kMaxIncidence_rad, kMaxIncidence_rad);
  return {foot + distance * std::tan(low), foot + distance * std::tan(high)};
}

double TurnTowards(const Facade& facade, const Vector2d& p, double along_m) {
  return std::atan2(along_m - FootOf(facade, p), DistanceTo(facade, p));
}

double LeastDepth(const Facade& facade, const Vector2d& p, const WallView& view) {
  double least = std::numeric_limits<double>::infinity();
  for (const Interval& part : view.seen) {
    for (const double along : {part.from_m, part.to_m}) {
      const Vector2d ray = facade.a + along * facade.along() - p;
      least = std::min(least, ray.dot(Direction(facade, view.turn_rad)));
    }
  }
  return std::isfinite(least) ? least : DistanceTo(facade, p);
}

Intervals InPhoto(const DippingSetting& setting, const Facade& facade, const Vector2d& p,
                  double turn_rad, std::span<const Interval> visible) {
  const double used_rad = 2 * std::atan((1 - kOverlap) * std::tan(setting.hfov_rad / 2));
  const Interval whole = Rounded(FieldWindow(facade, p, turn_rad, setting.hfov_rad));
  const Interval used = FieldWindow(facade, p, turn_rad, used_rad);
  Intervals result;
  for (const Interval& part : visible) {
    Interval seen{std::max(part.from_m, whole.from_m), std::min(part.to_m, whole.to_m)};
    if (part.from_m < whole.from_m) seen.from_m = Rounded(used).from_m;
    if (part.to_m > whole.to_m) seen.to_m = Rounded(used).to_m;
    if (seen.length_m() >= kLeastPieceM) result.push_back(seen);
  }
  return result;
}

SeenPart PartOf(const Facade& facade, const Vector2d& p, const WallView& view) {
  SeenPart part;
  part.share = Length(view.seen) / facade.length_m();
  part.frontality = std::cos(view.turn_rad);
  part.direction.head<2>() = Direction(facade, view.turn_rad);
  part.distance_m = DistanceTo(facade, p);
  return part;
}

double ScoreOf(const DippingSetting& setting, const Vector2d& p, const WallView& view) {
  const Facade& facade = setting.site.facades[view.facade];
  const SeenPart part = PartOf(facade, p, view);
  const double widest = setting.width_per_m * part.distance_m / facade.length_m();
  return ViewScore(QualityOfView(part, widest, setting.d_min_m, setting.d_max_m));
}

}  // namespace stucco::plan
