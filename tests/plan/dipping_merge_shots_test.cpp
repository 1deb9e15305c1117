// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/dipping/dipping_views.h"
#include "plan/dipping/merge_shots.h"
#include "tests/plan/made_hovers.h"
#include "tests/site/made_site.h"

namespace stucco::plan {
namespace {

// Two houses in one line, each with a south wall of 5 m.
class Row : public testing::Test {
 protected:
  Site site_ = MadeSite({Rectangle(0, 0, 5, 8), Rectangle(5, 0, 10, 8)}, {.heights_m = {6, 6}});
  Obstacles obstacles_{site_};
  DippingSetting setting_ = MakeSetting(site_, obstacles_, FindCamera("mavic-3e"), 60);

  int SouthWall(size_t house) const {
    for (size_t i = 0; i < site_.facades.size(); ++i) {
      const Facade& facade = site_.facades[i];
      if (facade.footprint == static_cast<int>(house) && facade.normal().y() < -0.9) {
        return static_cast<int>(i);
      }
    }
    return -1;
  }
  Shot At(size_t house, double yaw_rad, ViewKind kind = ViewKind::kDipping) const {
    return {yaw_rad, 0, kind, {{SouthWall(house), {0, 5}, {0.5, 6}}}};
  }
};

TEST_F(Row, OnePhotoHoldsBothWalls) {
  const Hover hover{{5, -12, 4}, {At(0, 0), At(1, 0)}};
  const std::vector<Shot> shots = MergeAlike(setting_, hover);
  ASSERT_EQ(shots.size(), 1u);
  EXPECT_EQ(shots[0].targets.size(), 2u);
  EXPECT_EQ(shots[0].yaw_rad, 0);
}

TEST_F(Row, LooksHalfWayBetweenTheTwo) {
  const Hover hover{{5, -14, 4}, {At(0, -0.1), At(1, 0.1)}};
  const std::vector<Shot> shots = MergeAlike(setting_, hover);
  ASSERT_EQ(shots.size(), 1u);
  EXPECT_NEAR(shots[0].yaw_rad, 0, 1e-12);
}

TEST_F(Row, KeepsWhatOnePhotoDoesNotHold) {
  const Hover near{{5, -5, 4}, {At(0, -0.1), At(1, 0.1)}};  // 90 degrees for both
  EXPECT_EQ(MergeAlike(setting_, near).size(), 2u);
  const Hover apart{{5, -12, 4}, {At(0, -0.3), At(1, 0.3)}};
  EXPECT_EQ(MergeAlike(setting_, apart).size(), 2u);
  const Hover kinds{{5, -12, 4}, {At(0, 0), At(1, 0, ViewKind::kDippingFoot)}};
  EXPECT_EQ(MergeAlike(setting_, kinds).size(), 2u);
}

TEST_F(Row, AFlushFrontTakesNoMorePhotosThanOneWallAsLong) {
  const Site whole = MadeSite({Rectangle(0, 0, 10, 8)}, {.heights_m = {6}});
  const Obstacles free(whole);
  const auto count = [](const DippingReport& report) {
    size_t photos = 0;
    for (const Hover& hover : report.hovers) photos += hover.shots.size();
    return photos;
  };
  Progress& progress = SilentProgress();
  const DippingSetting one = MakeSetting(whole, free, FindCamera("mavic-3e"), 60);
  const DippingReport row = PlanDippingViews(setting_, progress);
  EXPECT_LE(count(row), count(PlanDippingViews(one, progress)));
  for (const Intervals& gaps : NotMeant(site_, row.hovers)) EXPECT_LT(Length(gaps), 0.05);
}

}  // namespace
}  // namespace stucco::plan
