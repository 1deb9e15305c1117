// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/idle_shots.h"

#include <algorithm>

#include "plan/camera/photo_sights.h"
#include "plan/planar/lost_walls.h"

namespace stucco::plan {
namespace {

constexpr double kLeastShare = 0.1;

// What a photo shows of what is to be captured, as a share of its frame.
double ShareOf(const IdleSetting& setting, const Eigen::Vector3d& position, const Shot& shot) {
  double share = 0;
  for (const Sight& sight : SightsOf(setting.view, setting.patch_m2, position, shot)) {
    share += sight.share;
  }
  return share;
}

// Takes out the idle photos, each as a hover of its own. Hovers may be empty then.
std::vector<Hover> TakeIdleShots(const IdleSetting& setting, std::vector<Hover>& hovers) {
  std::vector<Hover> idle;
  for (Hover& hover : hovers) {
    std::erase_if(hover.shots, [&](const Shot& shot) {
      if (ShareOf(setting, hover.position, shot) >= kLeastShare) return false;
      idle.push_back({hover.position, {shot}});
      return true;
    });
  }
  return idle;
}

// Those of the idle photos that see what no other does.
std::vector<uint32_t> NeededOf(const IdleSetting& setting, std::span<const Hover> idle,
                               std::span<const Hover> busy) {
  const auto sight = [&](std::span<const Hover> hovers) {
    return FacadeSight(setting.site, setting.camera, setting.d_max_m, hovers);
  };
  return HoversForLostWalls(sight(idle), sight(busy), setting.threads);
}

}  // namespace

size_t DropIdleShots(const IdleSetting& setting, std::span<const Hover> others,
                     std::vector<Hover>& hovers) {
  const std::vector<Hover> idle = TakeIdleShots(setting, hovers);
  std::vector<Hover> busy = hovers;
  busy.insert(busy.end(), others.begin(), others.end());
  const std::vector<uint32_t> needed = NeededOf(setting, idle, busy);
  for (const uint32_t photo : needed) {
    const auto from = std::ranges::find(hovers, idle[photo].position, &Hover::position);
    from->shots.push_back(idle[photo].shots.front());
  }
  std::erase_if(hovers, [](const Hover& hover) { return hover.shots.empty(); });
  return idle.size() - needed.size();
}

}  // namespace stucco::plan
