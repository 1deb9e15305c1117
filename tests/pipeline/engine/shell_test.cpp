// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/shell.h"

#include <gtest/gtest.h>

namespace stucco {
namespace {

TEST(ShellWord, IsQuotedOnlyWhereAShellWouldReadItInAnotherWay) {
  EXPECT_EQ(ShellWord("/a/b-c_d.e+f,g:h=i@j%"), "/a/b-c_d.e+f,g:h=i@j%");
  EXPECT_EQ(ShellWord("schloß"), "schloß");
  EXPECT_EQ(ShellWord("a b"), "'a b'");
  EXPECT_EQ(ShellWord("~x"), "'~x'");
  EXPECT_EQ(ShellWord("$HOME"), "'$HOME'");
  EXPECT_EQ(ShellWord("it's"), "'it'\\''s'");
  EXPECT_EQ(ShellWord(""), "''");
}

}  // namespace
}  // namespace stucco
