// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/lift.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "plan/dipping/merge_shots.h"

namespace stucco::plan {
namespace {

constexpr double kFootSlackM = 0.2;   // of the wall's foot that may stay unseen: plinth, plants
constexpr double kFootMargin = 0.03;  // radians below the foot in the tilted photo
constexpr double kSteepest = 70 * std::numbers::pi / 180;

struct Stop {
  double z_m = 0;
  size_t dip = 0;
  double height_m = 0;
};

std::optional<double> FootPitch(double above_foot_m, double distance_m, double height_m) {
  if (above_foot_m - height_m / 2 <= kFootSlackM) return std::nullopt;
  const double vfov = 2 * std::atan(height_m / 2 / distance_m);
  const double depression = std::atan2(above_foot_m, distance_m);
  return -std::min(kSteepest, depression - vfov / 2 + kFootMargin);
}

std::vector<Stop> StopsFromTop(std::span<const Dip> dips) {
  std::vector<Stop> stops;
  for (size_t i = 0; i < dips.size(); ++i) {
    for (const double z : dips[i].z_m) stops.push_back({z, i, dips[i].height_m});
  }
  std::stable_sort(stops.begin(), stops.end(),
                   [](const Stop& a, const Stop& b) { return a.z_m > b.z_m; });
  return stops;
}

// Stops from the top down, those to be merged in one group.
std::vector<std::vector<Stop>> GroupStops(std::span<const Dip> dips, double vertical_step) {
  std::vector<std::vector<Stop>> groups;
  double reach_m = 0;  // overlap of the smallest photo of the last group
  for (const Stop& stop : StopsFromTop(dips)) {
    const double overlap_m = (1 - vertical_step) * stop.height_m;
    const bool joins = !groups.empty() &&
                       groups.back().front().z_m - stop.z_m <= std::min(reach_m, overlap_m) &&
                       std::none_of(groups.back().begin(), groups.back().end(),
                                    [&](const Stop& other) { return other.dip == stop.dip; });
    if (joins) {
      groups.back().push_back(stop);
      reach_m = std::min(reach_m, overlap_m);
    } else {
      groups.push_back({stop});
      reach_m = overlap_m;
    }
  }
  return groups;
}

// None where the wall lies above or below what the photo shows.
std::vector<Target> TargetsOf(const WallView& view, const Facade& facade, Interval z) {
  z = {std::max(z.from_m, facade.z_m.from_m), std::min(z.to_m, facade.z_m.to_m)};
  std::vector<Target> targets;
  if (!(z.from_m < z.to_m)) return targets;
  for (const Interval& part : view.seen) targets.push_back({view.facade, part, z});
  return targets;
}

Shot LevelShot(const WallView& view, const Facade& facade, Interval z) {
  const Eigen::Vector2d direction = Direction(facade, view.turn_rad);
  return {std::atan2(direction.x(), direction.y()), 0, ViewKind::kDipping,
          TargetsOf(view, facade, z)};
}

}  // namespace

Dip MakeDip(const Level& level, const DippingSetting& setting, const Eigen::Vector2d& p,
            const WallView& view) {
  const Facade& facade = setting.site.facades[view.facade];
  const double distance = LeastDepth(facade, p, view);
  Dip dip;
  dip.height_m = setting.height_per_m * distance;
  const double spare = (1 - setting.vertical_step) / 2 * dip.height_m;
  const double lowest = LowestAt(level, setting, p);
  const double highest = std::max(lowest, setting.site.CeilingAt(p));
  const double reach = dip.height_m / 2 - spare;
  double top = std::clamp(facade.z_m.to_m - reach, lowest, highest);
  double bottom = std::clamp(facade.z_m.from_m + reach, lowest, highest);
  if (top < bottom) {  // one photo holds the wall
    top = bottom = std::clamp((facade.z_m.from_m + facade.z_m.to_m) / 2, lowest, highest);
  }
  const double steps = std::ceil((top - bottom) / (setting.vertical_step * dip.height_m) - 1e-9);
  for (int i = 0; i <= steps; ++i) {
    dip.z_m.push_back(steps > 0 ? top - (top - bottom) * i / steps : top);
  }
  dip.foot_pitch = FootPitch(dip.z_m.back() - facade.z_m.from_m, distance, dip.height_m);
  return dip;
}

double HoveringCost(std::span<const Dip> dips, double vertical_step) {
  const std::vector<Stop> stops = StopsFromTop(dips);
  double cost = static_cast<double>(stops.size());
  for (size_t i = 1; i < stops.size(); ++i) {
    double saved = 0;
    for (size_t k = i; k-- > 0;) {
      const double reach =
          (1 - vertical_step) * std::min(stops[i].height_m, stops[k].height_m);  // tau_d
      const double d = stops[k].z_m - stops[i].z_m, sigma = reach / 3;
      if (d > (1 - vertical_step) * stops[i].height_m) break;
      if (stops[k].dip == stops[i].dip || d > reach) continue;
      saved = std::max(saved, std::exp(-d * d / (2 * sigma * sigma)));
    }
    cost -= saved;
  }
  return cost;
}

std::vector<Hover> Lift(const Level& level, const DippingSetting& setting,
                        const DippingPoint& point) {
  std::vector<Dip> dips;
  for (const WallView& view : point.views) {
    dips.push_back(MakeDip(level, setting, point.position, view));
  }
  const auto take = [](Shot shot, Hover& hover) {
    if (!shot.targets.empty()) hover.shots.push_back(std::move(shot));
  };
  std::vector<Hover> hovers;
  for (const std::vector<Stop>& group : GroupStops(dips, setting.vertical_step)) {
    const double z = (group.front().z_m + group.back().z_m) / 2;
    Hover hover{{point.position.x(), point.position.y(), z}, {}};
    for (const Stop& stop : group) {
      const WallView& view = point.views[stop.dip];
      const Facade& facade = setting.site.facades[view.facade];
      const Dip& dip = dips[stop.dip];
      const double half = dip.height_m / 2;
      take(LevelShot(view, facade, {z - half, z + half}), hover);
      if (stop.z_m == dip.z_m.back() && dip.foot_pitch) {
        Shot foot = LevelShot(view, facade, {facade.z_m.from_m, z - half});
        foot.kind = ViewKind::kDippingFoot;
        foot.pitch_rad = *dip.foot_pitch;
        take(std::move(foot), hover);
      }
    }
    hover.shots = MergeAlike(setting, hover);
    for (Shot& shot : hover.shots) shot = Aimed(setting, hover, shot);
    if (!hover.shots.empty()) hovers.push_back(std::move(hover));
  }
  return hovers;
}

}  // namespace stucco::plan
