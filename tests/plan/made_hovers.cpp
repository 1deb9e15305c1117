// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/plan/made_hovers.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace stucco::plan {

using Eigen::Vector2d;
using Eigen::Vector3d;

namespace {

Hover One(const Vector3d& position, double yaw, std::vector<int> facades = {}) {
  Hover hover;
  hover.position = position;
  hover.shots.push_back({.yaw_rad = yaw, .targets = {}});
  for (const int facade : facades) hover.shots.back().targets.push_back({facade, {}, {}});
  return hover;
}

Hover Five(const Vector3d& position) {
  Hover hover;
  hover.position = position;
  hover.shots.push_back(
      {.pitch_rad = -std::numbers::pi / 2, .kind = ViewKind::kNadir, .targets = {}});
  for (int k = 0; k < 4; ++k) {
    hover.shots.push_back({.yaw_rad = k * std::numbers::pi / 2,
                           .pitch_rad = -std::numbers::pi / 4,
                           .kind = ViewKind::kOblique,
                           .targets = {}});
  }
  return hover;
}

}  // namespace

Hover Looking(const Eigen::Vector3d& from, double yaw_deg, double pitch_deg) {
  return {from,
          {{.yaw_rad = yaw_deg * std::numbers::pi / 180,
            .pitch_rad = pitch_deg * std::numbers::pi / 180,
            .targets = {}}}};
}

std::vector<Hover> RandomHovers(int count, uint64_t seed) {
  std::mt19937_64 random(seed);
  const double side = 15 * std::sqrt(count);
  std::uniform_real_distribution<double> at(0, side);
  std::uniform_real_distribution<double> yaw(0, 2 * std::numbers::pi);
  std::vector<Hover> hovers;
  for (int k = 0; k < count; ++k) {
    const double x = at(random);
    const double y = at(random);
    hovers.push_back(One({x, y, 60}, yaw(random)));
  }
  return hovers;
}

std::vector<Hover> LatticeHovers(int count) {
  const int columns = static_cast<int>(std::sqrt(count));
  std::vector<Hover> hovers;
  for (int k = 0; k < count; ++k) {
    hovers.push_back(Five({14.0 * (k % columns), 10.0 * (k / columns), 60}));
  }
  return hovers;
}

std::vector<Hover> DippingHovers(const Obstacles& obstacles) {
  const Site& site = obstacles.site();
  std::vector<Hover> hovers;
  for (size_t f = 0; f < site.facades.size(); ++f) {
    const Facade& facade = site.facades[f];
    const int count = std::max(1, static_cast<int>(std::ceil(facade.length_m() / 8)));
    const Vector2d normal = facade.normal();
    const double yaw = std::atan2(-normal.x(), -normal.y());
    for (int k = 0; k < count; ++k) {
      const Vector2d at =
          facade.a + (k + 0.5) / count * (facade.b - facade.a) + (site.d_min_m + 1) * normal;
      for (double z = site.safe_altitude_m; z > 5; z -= 9) {
        if (!obstacles.IsFree({at.x(), at.y(), z})) break;
        hovers.push_back(One({at.x(), at.y(), z}, yaw, {static_cast<int>(f)}));
      }
    }
  }
  return hovers;
}

std::vector<Intervals> NotMeant(const Site& site, const std::vector<Hover>& hovers) {
  std::vector<Intervals> meant(site.facades.size());
  for (const Hover& hover : hovers) {
    for (const Shot& shot : hover.shots) {
      for (const Target& target : shot.targets) meant[target.facade].push_back(target.along_m);
    }
  }
  std::vector<Intervals> gaps;
  for (size_t i = 0; i < meant.size(); ++i) {
    gaps.push_back(Gaps(Union(std::move(meant[i])), {0, site.facades[i].length_m()}));
  }
  return gaps;
}

}  // namespace stucco::plan
