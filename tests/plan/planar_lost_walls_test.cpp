// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <numbers>

#include "plan/planar/lost_walls.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using Indices = std::vector<uint32_t>;

// Around a house of 20 m by 10 m: before its south side, the same nearer, its east, north and west
// side.
std::vector<Hover> Around() {
  const auto at = [](double x, double y, double yaw_deg) {
    return Hover{{x, y, 5}, {{.yaw_rad = yaw_deg * std::numbers::pi / 180, .targets = {}}}};
  };
  return {at(10, -25, 0), at(10, -12, 0), at(45, 5, -90), at(10, 35, 180), at(-25, 5, 90)};
}

Indices Lost(const std::vector<Hover>& full, const std::vector<Hover>& kept) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 20, 10)}, {.heights_m = {9}});
  const CameraPreset camera = FindCamera("mavic-3e");
  return HoversForLostWalls(FacadeSight(site, camera, 80, full),
                            FacadeSight(site, camera, 80, kept), 2);
}

TEST(LostWalls, AreNoneWhereAllStays) {
  EXPECT_EQ(Lost(Around(), Around()), Indices{});
  std::vector<Hover> kept = Around();
  kept.erase(kept.begin() + 1);  // the nearer one shows nothing of its own
  EXPECT_EQ(Lost(Around(), kept), Indices{});
}

TEST(LostWalls, AreSeenAgainByAsFewHoversAsItTakes) {
  EXPECT_EQ(Lost(Around(), {Around()[3], Around()[4]}), (Indices{0, 2}));
  EXPECT_EQ(Lost(Around(), {}), (Indices{0, 2, 3, 4}));
}

TEST(LostWalls, OfAnEmptyGridCannotBeFound) {
  EXPECT_EQ(Lost({}, Around()), Indices{});
  EXPECT_EQ(Lost({}, {}), Indices{});
}

TEST(PutBack, GivesAHoverItsPhotosAgainOrAddsIt) {
  const Hover whole{{1, 2, 28}, {Shot{}, Shot{.yaw_rad = 1, .targets = {}}}};
  std::vector<Hover> hovers{{{1, 2, 28}, {Shot{}}}, {{9, 2, 28}, {Shot{}}}};
  PutBack(whole, hovers);
  ASSERT_EQ(hovers.size(), 2U);
  EXPECT_EQ(hovers[0].shots.size(), 2U);
  EXPECT_EQ(hovers[1].shots.size(), 1U);
  PutBack({{5, 5, 28}, {Shot{}}}, hovers);
  EXPECT_EQ(hovers.size(), 3U);
}

}  // namespace
}  // namespace stucco::plan
