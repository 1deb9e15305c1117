// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/platform.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;

// A file that is opened anew, as another process would.
class OpenFile {
 public:
  explicit OpenFile(const fs::path& path) : file_(open(path.c_str(), O_RDWR | O_CREAT, 0666)) {}
  ~OpenFile() { close(file_); }
  OpenFile(const OpenFile&) = delete;
  OpenFile& operator=(const OpenFile&) = delete;

  LockResult Lock(LockMode mode) const { return RealPlatform().lock_file(file_, mode); }

 private:
  int file_;
};

TEST(Platform, ALockKeepsOthersOutUntilItIsGone) {
  const FakeSurvey fake;
  const OpenFile second(fake.root / "lock");
  {
    const OpenFile first(fake.root / "lock");
    EXPECT_EQ(first.Lock(LockMode::kExclusive), LockResult::kHeld);
    EXPECT_EQ(second.Lock(LockMode::kExclusive), LockResult::kTaken);
    EXPECT_EQ(second.Lock(LockMode::kShared), LockResult::kTaken);
  }
  EXPECT_EQ(second.Lock(LockMode::kShared), LockResult::kHeld);
  const OpenFile third(fake.root / "lock");
  EXPECT_EQ(third.Lock(LockMode::kShared), LockResult::kHeld);
  EXPECT_EQ(third.Lock(LockMode::kExclusive), LockResult::kTaken);
}

TEST(Platform, WhatIsNoOpenFileCannotBeLocked) {
  EXPECT_EQ(RealPlatform().lock_file(-1, LockMode::kExclusive), LockResult::kImpossible);
}

TEST(Platform, FoldersChangePlacesOrNothingHappens) {
  const FakeSurvey fake;
  const fs::path a = fake.root / "a", b = fake.root / "b";
  fs::create_directories(a);
  fs::create_directories(b);
  WriteFile(a / "x", "of a");
  EXPECT_FALSE(RealPlatform().exchange_folders(a, fake.root / "none"));
  EXPECT_EQ(ReadFile(a / "x"), "of a");
  if (!RealPlatform().exchange_folders(a, b)) {
    GTEST_SKIP() << "this file system cannot exchange folders";
  }
  EXPECT_EQ(ReadFile(b / "x"), "of a");
  EXPECT_FALSE(fs::exists(a / "x"));
}

TEST(Platform, IsNotInterruptedByItself) {
  EXPECT_FALSE(RealPlatform().interrupted());
}

}  // namespace
}  // namespace stucco
