// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "plan/camera/preset.h"
#include "plan/planar/idle_shots.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

// A shed of 3 m by 3 m by 3 m.
Site Shed() {
  return MadeSite(std::vector<Ring>{Rectangle(0, 0, 3, 3)}, {.heights_m = {3}});
}

Shot Looking(double yaw_deg) {
  return {.yaw_rad = yaw_deg * std::numbers::pi / 180, .targets = {}};
}

// 20 m before the shed's south side, and 6 m before it.
Hover Far(std::vector<Shot> shots) {
  return {{1.5, -20, 2}, std::move(shots)};
}
Hover Near(std::vector<Shot> shots) {
  return {{1.5, -6, 2}, std::move(shots)};
}

size_t Drop(std::vector<Hover>& hovers) {
  const Site site = Shed();
  const SurfaceView view(site, FindCamera("mavic-3e").Field(),
                         SampleSurface(site, {.spacing_m = 1, .ground_reach_m = 3}), 60);
  return DropIdleShots(view, 1, 2, hovers);
}

TEST(IdleShots, AreNotTaken) {
  std::vector<Hover> hovers{Near({Looking(0), Looking(90)}), Far({Looking(180)}),
                            Far({Looking(0)})};
  EXPECT_EQ(Drop(hovers), 3U);
  ASSERT_EQ(hovers.size(), 1U);
  ASSERT_EQ(hovers[0].shots.size(), 1U);
  EXPECT_EQ(hovers[0].shots[0].yaw_rad, 0);
  EXPECT_EQ(hovers[0].position.y(), -6);
}

TEST(IdleShots, OfNoHoversAreNone) {
  std::vector<Hover> hovers;
  EXPECT_EQ(Drop(hovers), 0U);
}

}  // namespace
}  // namespace stucco::plan
