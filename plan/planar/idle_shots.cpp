// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/idle_shots.h"

#include "plan/camera/photo_sights.h"

namespace stucco::plan {
namespace {

constexpr double kLeastShare = 0.1;

}  // namespace

size_t DropIdleShots(const SurfaceView& view, double patch_m2, std::vector<Hover>& hovers) {
  size_t dropped = 0;
  for (Hover& hover : hovers) {
    dropped += std::erase_if(hover.shots, [&](const Shot& shot) {
      double share = 0;
      for (const Sight& sight : SightsOf(view, patch_m2, hover.position, shot)) {
        share += sight.share;
      }
      return share < kLeastShare;
    });
  }
  std::erase_if(hovers, [](const Hover& hover) { return hover.shots.empty(); });
  return dropped;
}

}  // namespace stucco::plan
