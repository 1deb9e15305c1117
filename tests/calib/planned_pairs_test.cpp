// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/planned_pairs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;
using testing::Pair;

PlannedView View(const std::string& id, int hover, Interval along, Interval z) {
  PlannedView view;
  view.id = id;
  view.hover = hover;
  view.targets = {{"B0001/F00", along, z}};
  return view;
}

class PlannedPairsTest : public testing::Test {
 protected:
  PlannedPairsTest() {
    plan_.views = {View("v0", 0, {0, 10}, {0, 8}), View("v1", 1, {8, 18}, {0, 8}),
                   View("v2", 2, {18, 25}, {0, 8}), View("v3", 3, {0, 10}, {7, 15})};
  }
  std::vector<std::pair<int, int>> Pairs(const std::vector<std::string>& views) {
    photos_.assign(views.size(), {});
    std::vector<const CapturedPhoto*> pointers;
    for (size_t i = 0; i < views.size(); ++i) {
      photos_[i].view = views[i];
      pointers.push_back(&photos_[i]);
    }
    return PairsOfPlan(plan_, pointers);
  }
  Plan plan_;
  std::vector<CapturedPhoto> photos_;
};

TEST_F(PlannedPairsTest, AreViewsThatOverlapOnAWall) {
  EXPECT_THAT(Pairs({"v3", "v2", "v1", "v0"}), ElementsAre(Pair(0, 2), Pair(0, 3), Pair(2, 3)));
}

TEST_F(PlannedPairsTest, AreViewsOfOneHover) {
  plan_.views[2].hover = 0;
  EXPECT_THAT(Pairs({"v0", "v2"}), ElementsAre(Pair(0, 1)));
}

TEST_F(PlannedPairsTest, AreNoneForPhotosOutsideThePlan) {
  EXPECT_THAT(Pairs({"", "v1", ""}), IsEmpty());
}

}  // namespace
}  // namespace stucco
