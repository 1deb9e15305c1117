// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/progress.h"

namespace stucco {
namespace {

TEST(Console, FormatsForPeople) {
  EXPECT_EQ(DurationText(0.04), "0.0 s");
  EXPECT_EQ(DurationText(9.97), "10 s");
  EXPECT_EQ(DurationText(59.6), "1 min 00 s");
  EXPECT_EQ(DurationText(7620), "2 h 07 min");
  EXPECT_EQ(DurationText(-1), "unknown");
  EXPECT_EQ(MemoryText(812.4), "812 MiB");
  EXPECT_EQ(MemoryText(3277), "3.2 GiB");
  EXPECT_EQ(GroupedDigits(7), "7");
  EXPECT_EQ(GroupedDigits(1234567), "1 234 567");
}

TEST(Console, ThatCannotBeWrittenStopsNothing) {
  std::FILE* file = std::fopen("/dev/full", "w");
  if (file == nullptr) {
    GTEST_SKIP() << "there is no /dev/full here";
  }
  Console console(file, true, Verbosity::kVerbose);
  EventLog no_events;
  {
    StageProgress progress("calib", console, no_events, [] { return false; });
    progress.Begin("matching", 3);
    progress.Warn("a warning");
    EXPECT_NO_THROW(console.Bar("a bar"));
  }
  EXPECT_NO_THROW(console.Line(std::string(100'000, 'x')));
  std::fclose(file);
}

}  // namespace
}  // namespace stucco
