// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/relief/stretch.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

void Expect(const std::vector<double>& speaks, const Stretch& expected) {
  const Stretch found = LargestStretch(speaks);
  EXPECT_EQ(found.begin, expected.begin);
  EXPECT_EQ(found.end, expected.end);
  EXPECT_EQ(found.low, expected.low);
  EXPECT_EQ(found.high, expected.high);
}

TEST(LargestStretch, LiesBetweenGaps) {
  Expect({2, 2, 0, 0, 0, 3, 3, 0.1, 0, 0, 0, 2, 1}, {5, 7, 2, 11});
  Expect({5, 5, 0, 0, 0, 1}, {0, 2, 0, 5});
  Expect({1, 0, 0, 0, 2, 4, 0}, {4, 6, 1, 7});
}

TEST(LargestStretch, NarrowGapsAreNone) {
  Expect({2, 0, 0, 2, 0, 2}, {0, 6, 0, 6});
}

TEST(LargestStretch, IsAllWhereNothingSpeaks) {
  Expect({0, 0, 0}, {0, 3, 0, 3});
}

}  // namespace
}  // namespace stucco
