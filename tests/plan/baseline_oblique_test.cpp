// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/baseline/oblique.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

TEST(ObliqueViews, AreTheWholeGrid) {
  const Site site = MadeSite(std::vector<Ring>{Rectangle(0, 0, 60, 30)},
                             {.safe_altitude_m = 30, .heights_m = {12}});
  const CameraPreset camera = FindCamera("mavic-3e");
  const auto views = ObliqueViews(site, camera, {});
  const auto grid = GridHovers(site, camera, {});
  ASSERT_EQ(views.size(), grid.size());
  ASSERT_GT(views.size(), 100U);
  for (size_t i = 0; i < views.size(); ++i) {
    EXPECT_EQ(views[i].position, grid[i].position);
    ASSERT_EQ(views[i].shots.size(), 5U);
    for (const Shot& shot : views[i].shots) EXPECT_TRUE(shot.targets.empty());
  }
}

}  // namespace
}  // namespace stucco::plan
