// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include "plan/match/ties.h"

namespace stucco::plan {
namespace {

// Photos at their hovers, and which of them match.
class MadeTies {
 public:
  explicit MadeTies(const std::vector<uint32_t>& hovers) : ties_(hovers.size()) {
    for (const uint32_t hover : hovers) places_.push_back({hover, 0});
  }
  MadeTies& Match(uint32_t a, uint32_t b) {
    ties_[a].strong.push_back({b, 0.2F, 0});
    ties_[b].strong.push_back({a, 0.2F, 0});
    return *this;
  }
  MadeTies& MatchAll(const std::vector<uint32_t>& photos) {
    for (const uint32_t a : photos) {
      for (const uint32_t b : photos) {
        if (a < b) Match(a, b);
      }
    }
    return *this;
  }
  std::vector<LooseGroup> Groups() const { return LooseGroups(places_, ties_); }

 private:
  std::vector<PhotoPlace> places_;
  std::vector<Ties> ties_;
};

TEST(LooseGroups, OfPhotosThatAllMatchThereAreNone) {
  EXPECT_TRUE(MadeTies({0, 1, 2}).MatchAll({0, 1, 2}).Groups().empty());
  EXPECT_TRUE(MadeTies({}).Groups().empty());
}

// Two photos from one place give what hangs on them no scale.
TEST(LooseGroups, HangOnAllPhotosOfAHover) {
  MadeTies ties({0, 1, 2, 3, 3, 4, 5});
  ties.MatchAll({0, 1, 2, 3}).Match(4, 0).Match(4, 1).Match(5, 6);
  ties.Match(5, 3).Match(5, 4).Match(6, 3).Match(6, 4);
  const auto groups = ties.Groups();
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].photos, (std::vector<uint32_t>{5, 6}));
  EXPECT_EQ(groups[0].on, 3);
  EXPECT_TRUE(groups[0].Holds(6));
  EXPECT_FALSE(groups[0].Holds(4));
  EXPECT_TRUE(ties.Match(6, 0).Groups().empty());
}

// A hover's photos may look different ways: what ties one does not tie the other.
TEST(LooseGroups, ArePhotosThatOnlyShareHoversWithTheRest) {
  const auto groups =
      MadeTies({0, 1, 2, 0, 1, 2}).MatchAll({0, 1, 2}).Match(3, 4).Match(4, 5).Groups();
  ASSERT_EQ(groups.size(), 1u);
  EXPECT_EQ(groups[0].photos, (std::vector<uint32_t>{3, 4, 5}));
  EXPECT_EQ(groups[0].on, -1);
}

}  // namespace
}  // namespace stucco::plan
