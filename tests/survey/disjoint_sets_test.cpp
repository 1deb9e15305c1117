// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/disjoint_sets.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(DisjointSets, AreAloneUntilTheyAreJoined) {
  DisjointSets sets(4);
  EXPECT_EQ(sets.size(), 4U);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(sets.Find(i), i);
}

TEST(DisjointSets, AreNamedByTheirSmallestMember) {
  DisjointSets sets(5);
  EXPECT_TRUE(sets.Join(4, 3));
  EXPECT_TRUE(sets.Join(1, 2));
  EXPECT_TRUE(sets.Join(2, 4));
  EXPECT_FALSE(sets.Join(1, 3));
  for (int i = 1; i < 5; ++i) EXPECT_EQ(sets.Find(i), 1);
  EXPECT_EQ(sets.Find(0), 0);
}

TEST(DisjointSets, MayBeNone) {
  EXPECT_EQ(DisjointSets(0).size(), 0U);
}

TEST(DisjointSetsDeathTest, RequireMembers) {
  DisjointSets sets(3);
  EXPECT_DEATH(sets.Find(3), "member");
  EXPECT_DEATH(sets.Join(0, -1), "member");
}

}  // namespace
}  // namespace stucco
