// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/planar/idle_shots.h"

#include <atomic>

#include "plan/camera/photo_sights.h"
#include "survey/parallel.h"

namespace stucco::plan {
namespace {

constexpr double kLeastShare = 0.1;

}  // namespace

size_t DropIdleShots(const SurfaceView& view, double patch_m2, int threads,
                     std::vector<Hover>& hovers) {
  std::atomic<size_t> dropped = 0;
  ParallelFor(hovers.size(), threads, [&](size_t i) {
    dropped += std::erase_if(hovers[i].shots, [&](const Shot& shot) {
      double share = 0;
      for (const Sight& sight : SightsOf(view, patch_m2, hovers[i].position, shot)) {
        share += sight.share;
      }
      return share < kLeastShare;
    });
  });
  std::erase_if(hovers, [](const Hover& hover) { return hover.shots.empty(); });
  return dropped;
}

}  // namespace stucco::plan
