// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "plan/evaluate/facade_sight.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

constexpr double kDMax = 80;

TEST(FacadeSight, MeasuresAPartByItsShareFrontalityAndDistance) {
  const Site site = LoneHouse();
  const std::vector<Hover> hovers{Looking({10, -20, 4.5}, 30)};
  const FacadeSight sight(site, FindCamera("mavic-3e"), kDMax, hovers);
  const auto views = sight.ViewsOf(0);
  ASSERT_EQ(views.size(), 1U);
  const std::vector<uint32_t> cells{0, 19};  // both ends of the lowest row
  const SeenPart part = sight.PartOf(0, views[0], cells);
  EXPECT_NEAR(part.share, 2.0 / 180, 1e-12);
  EXPECT_NEAR(part.frontality, std::cos(std::numbers::pi / 6), 1e-12);
  EXPECT_NEAR(part.distance_m, std::hypot(20, 4), 1e-9);
  EXPECT_GT(sight.ScoreOf(0, sight.PartOf(0, views[0], views[0].cells)), sight.ScoreOf(0, part));
}

}  // namespace
}  // namespace stucco::plan
