// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/dipping/merge_shots.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>

namespace stucco::plan {
namespace {

// Farther apart than this, one of the walls would be seen at more of a slant than planned.
constexpr double kAlike_rad = 15 * std::numbers::pi / 180;
// What a target may stand out of the photo, as a share of its size: parts are rounded.
constexpr double kSlack = 0.02;

bool Holds(const DippingSetting& setting, const Hover& hover, const Shot& shot) {
  const FieldOfView field{(1 + kSlack) * setting.width_per_m / 2,
                          (1 + kSlack) * setting.height_per_m / 2};
  const Frustum frame = LevelFrustum(field, hover.position, shot.yaw_rad, shot.pitch_rad,
                                     std::numeric_limits<double>::infinity());
  return std::ranges::all_of(shot.targets, [&](const Target& target) {
    const Facade& facade = setting.site.facades[target.facade];
    for (const double along : {target.along_m.from_m, target.along_m.to_m}) {
      const Eigen::Vector2d at = facade.a + along * facade.along();
      for (const double z : {target.z_m.from_m, target.z_m.to_m}) {
        if (!frame.Contains({at.x(), at.y(), z})) return false;
      }
    }
    return true;
  });
}

// One photo for both, from half way between them if that holds everything.
std::optional<Shot> Merged(const DippingSetting& setting, const Hover& hover, const Shot& a,
                           const Shot& b) {
  if (a.kind != b.kind) return std::nullopt;
  const double yaw = std::remainder(b.yaw_rad - a.yaw_rad, 2 * std::numbers::pi);
  const double pitch = b.pitch_rad - a.pitch_rad;
  if (std::hypot(yaw, pitch) > kAlike_rad) return std::nullopt;
  Shot both = a;
  both.targets.insert(both.targets.end(), b.targets.begin(), b.targets.end());
  for (const double share : {0.5, 0.0, 1.0}) {
    both.yaw_rad = std::remainder(a.yaw_rad + share * yaw, 2 * std::numbers::pi);
    both.pitch_rad = a.pitch_rad + share * pitch;
    if (Holds(setting, hover, both)) return both;
  }
  return std::nullopt;
}

// The angles under which the corners of a photo's targets lie: azimuths from its yaw, elevations
// from the horizon.
struct Angles {
  Interval azimuth_rad{std::numeric_limits<double>::infinity(),
                       -std::numeric_limits<double>::infinity()};
  Interval elevation_rad = azimuth_rad;
};

void Extend(Interval& interval, double value) {
  interval = {std::min(interval.from_m, value), std::max(interval.to_m, value)};
}

Angles AnglesOf(const DippingSetting& setting, const Hover& hover, const Shot& shot) {
  Angles out;
  for (const Target& target : shot.targets) {
    const Facade& facade = setting.site.facades[target.facade];
    for (const double along : {target.along_m.from_m, target.along_m.to_m}) {
      const Eigen::Vector2d ray = facade.a + along * facade.along() - hover.position.head<2>();
      Extend(out.azimuth_rad,
             std::remainder(std::atan2(ray.x(), ray.y()) - shot.yaw_rad, 2 * std::numbers::pi));
      for (const double z : {target.z_m.from_m, target.z_m.to_m}) {
        Extend(out.elevation_rad, std::atan2(z - hover.position.z(), ray.norm()));
      }
    }
  }
  return out;
}

double Middle(const Interval& interval) {
  return (interval.from_m + interval.to_m) / 2;
}

}  // namespace

Shot Aimed(const DippingSetting& setting, const Hover& hover, const Shot& shot) {
  if (shot.kind != ViewKind::kDipping || shot.targets.empty()) return shot;
  if (!Holds(setting, hover, shot)) return shot;
  const Angles angles = AnglesOf(setting, hover, shot);
  const double turn = std::clamp(Middle(angles.azimuth_rad), -kMostAim_rad, kMostAim_rad);
  const double tilt = std::clamp(Middle(angles.elevation_rad) - shot.pitch_rad, -kMostAim_rad, 0.0);
  for (const double share : {1.0, 0.75, 0.5, 0.25}) {
    Shot aimed = shot;
    aimed.yaw_rad = std::remainder(shot.yaw_rad + share * turn, 2 * std::numbers::pi);
    aimed.pitch_rad += share * tilt;
    if (Holds(setting, hover, aimed)) return aimed;
  }
  return shot;
}

std::vector<Shot> MergeAlike(const DippingSetting& setting, const Hover& hover) {
  std::vector<Shot> out;
  for (const Shot& shot : hover.shots) {
    const bool merged = std::ranges::any_of(out, [&](Shot& other) {
      const std::optional<Shot> both = Merged(setting, hover, other, shot);
      if (both) other = *both;
      return both.has_value();
    });
    if (!merged) out.push_back(shot);
  }
  return out;
}

}  // namespace stucco::plan
