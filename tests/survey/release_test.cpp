// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/release.h"

#include <gtest/gtest.h>

#include <vector>

namespace stucco {
namespace {

TEST(Release, LeavesNoCapacity) {
  std::vector<int> numbers(1000, 7);
  Release(numbers);
  EXPECT_TRUE(numbers.empty());
  EXPECT_EQ(numbers.capacity(), 0);
}

}  // namespace
}  // namespace stucco
