// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "plan/map/closed_off.h"
#include "plan/space/obstacles.h"
#include "tests/plan/made_map.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

// Three houses in a row, with a ring of no-fly area around the second.
class ClosedOff : public testing::Test {
 protected:
  ClosedOff()
      : site_(MadeSite(
            {Rectangle(0, 0, 20, 12), Rectangle(60, 0, 80, 12), Rectangle(120, 0, 140, 12)},
            {.safe_altitude_m = 30, .margin_m = 30, .heights_m = {10, 10, 10}})) {
    site_.no_fly = {{{Rectangle(30, -30, 110, 45), Reversed(Rectangle(35, -25, 105, 40))}}};
  }

  bool IsFree(double x, double y) const {
    return Obstacles(site_).IsFree(Eigen::Vector3d(x, y, site_.CeilingAt({x, y})));
  }

  Site site_;
};

TEST_F(ClosedOff, AHoleThatHomeIsNotIn) {
  site_.home = {10, -40, 0};
  EXPECT_TRUE(IsFree(70, 30));
  CloseOff(site_);
  ASSERT_EQ(site_.closed_off.size(), 1u);
  EXPECT_NEAR(Area(site_.closed_off[0]), 70 * 65, 1e-6);
  EXPECT_FALSE(IsFree(70, 30));
  EXPECT_FALSE(IsFree(70, 42));
  EXPECT_TRUE(IsFree(70, -50));
  EXPECT_THAT(site_.warnings, ElementsAre(HasSubstr("no way from home to B0002:")));
}

TEST_F(ClosedOff, AllAroundTheHoleThatHomeIsIn) {
  site_.home = {98, 20, 0};
  CloseOff(site_);
  EXPECT_TRUE(IsFree(70, 30));
  EXPECT_FALSE(IsFree(70, 42));
  EXPECT_FALSE(IsFree(70, -50));
  EXPECT_FALSE(IsFree(160, 0));
  EXPECT_THAT(site_.warnings, ElementsAre(HasSubstr("no way from home to B0001, B0003:")));
}

TEST_F(ClosedOff, ZonesInAHoleStayThemselves) {
  site_.home = {10, -40, 0};
  site_.no_fly.push_back({{Rectangle(85, 25, 95, 35)}});
  CloseOff(site_);
  double area = 0;
  for (const Polygon& part : site_.closed_off) area += Area(part);
  EXPECT_NEAR(area, 70 * 65 - 100, 1e-6);
}

TEST_F(ClosedOff, ASiteThatNothingReachesIsRefused) {
  site_.no_fly = {{{Rectangle(-60, -60, 200, 80), Reversed(Rectangle(-50, -50, 190, 70))}}};
  site_.home = {300, 0, 0};
  EXPECT_THAT(Complaint([&] { CloseOff(site_); }),
              testing::AllOf(HasSubstr("no way from home to any building"), HasSubstr("--home")));
}

TEST_F(ClosedOff, NothingWithoutHoles) {
  site_.no_fly = {{{Rectangle(30, -30, 50, 45)}}};
  CloseOff(site_);
  EXPECT_TRUE(site_.closed_off.empty());
  EXPECT_TRUE(site_.warnings.empty());
}

}  // namespace
}  // namespace stucco::plan
