// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/path/facade_cuts.h"

namespace stucco::plan {
namespace {

// A tour whose hovers capture these facades each.
std::vector<Hover> TourOf(const std::vector<std::vector<int>>& facades) {
  std::vector<Hover> tour;
  for (const std::vector<int>& of : facades) {
    Hover& hover = tour.emplace_back();
    hover.shots.emplace_back();
    for (const int facade : of) hover.shots[0].targets.push_back({facade, {}, {}});
  }
  return tour;
}

TEST(FacadesDivided, CountsFacadesOnBothSides) {
  EXPECT_EQ(FacadesDivided(TourOf({{0}, {0, 1}, {0, 1}, {1}, {}, {2}}), 3),
            (std::vector<int>{1, 2, 1, 0, 0, 0}));
}

TEST(FacadesDivided, AFacadeMaySpanTheEndOfTheTour) {
  EXPECT_EQ(FacadesDivided(TourOf({{0}, {0}, {}, {}, {}, {0}}), 1),
            (std::vector<int>{1, 0, 0, 0, 0, 1}));
}

TEST(FacadesDivided, OtherPhotosInBetweenDivideNothingLess) {
  EXPECT_EQ(FacadesDivided(TourOf({{0}, {}, {0}, {}, {}, {}}), 1),
            (std::vector<int>{1, 1, 0, 0, 0, 0}));
}

TEST(FacadesDivided, OfNothingIsNothing) {
  EXPECT_TRUE(FacadesDivided({}, 2).empty());
  EXPECT_EQ(FacadesDivided(TourOf({{0}, {1}}), 2), (std::vector<int>{0, 0}));
}

}  // namespace
}  // namespace stucco::plan
