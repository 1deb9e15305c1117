// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/groups.h"

#include <gtest/gtest.h>

namespace stucco::test {
namespace {

TEST(Groups, AreAloneUntilTheyAreJoined) {
  Groups groups(4);
  for (int i = 0; i < 4; ++i) EXPECT_EQ(groups.Of(i), i);
}

TEST(Groups, AreNamedByTheirFirstMember) {
  Groups groups(5);
  EXPECT_TRUE(groups.Join(4, 3));
  EXPECT_TRUE(groups.Join(1, 2));
  EXPECT_TRUE(groups.Join(2, 4));
  EXPECT_FALSE(groups.Join(1, 3));
  for (int i = 1; i < 5; ++i) EXPECT_EQ(groups.Of(i), 1);
  EXPECT_EQ(groups.Of(0), 0);
}

}  // namespace
}  // namespace stucco::test
