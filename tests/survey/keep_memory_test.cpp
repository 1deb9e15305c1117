// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/keep_memory.h"

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cstring>
#include <memory>

namespace stucco {
namespace {

constexpr size_t kBytes = 24 << 20;

// Pages that the system had to provide while a block was filled.
long PagesFor(size_t bytes) {
  rusage before = {};
  rusage after = {};
  getrusage(RUSAGE_SELF, &before);
  const std::unique_ptr<char[]> block(new char[bytes]);
  std::memset(block.get(), 1, bytes);
  EXPECT_EQ(block[bytes / 2], 1);
  getrusage(RUSAGE_SELF, &after);
  return after.ru_minflt - before.ru_minflt;
}

#ifdef __GLIBC__
TEST(KeepFreedMemory, UsesAPictureAgain) {
  KeepFreedMemory();
  PagesFor(kBytes);
  EXPECT_LT(PagesFor(kBytes), 100);  // 6 144 where all of them come anew
}
#endif

}  // namespace
}  // namespace stucco
