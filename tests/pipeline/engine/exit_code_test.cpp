// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/exit_code.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <new>
#include <system_error>

#include "survey/error.h"

namespace stucco {
namespace {

using testing::HasSubstr;

TEST(Failure, OfWritingTellsAFullDiskFromAForbiddenOne) {
  for (const int error : {ENOSPC, EDQUOT}) {
    EXPECT_EQ(WriteError("a/b", "cannot be written", error).kind(), ErrorKind::kOutOfResource);
  }
  const Error forbidden = WriteError("a/b", "cannot be written", EACCES);
  EXPECT_EQ(forbidden.kind(), ErrorKind::kBadInput);
  EXPECT_STREQ(forbidden.what(), "a/b: cannot be written (Permission denied)");
}

}  // namespace
}  // namespace stucco
