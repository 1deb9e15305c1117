// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/utf8.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(IsPrintableUtf8, KnowsWellFormedSequences) {
  EXPECT_TRUE(IsPrintableUtf8(""));
  EXPECT_TRUE(IsPrintableUtf8("plain"));
  EXPECT_TRUE(IsPrintableUtf8("é ש 漢 😀"));
  for (const char* bad : {"\x80", "\xc0\xaf", "\xe0\x80\x80", "\xed\xa0\x80", "\xf4\x90\x80\x80",
                          "\xe6\xbc", "a\tb", "\x7f"}) {
    EXPECT_FALSE(IsPrintableUtf8(bad)) << bad;
  }
}

}  // namespace
}  // namespace stucco
