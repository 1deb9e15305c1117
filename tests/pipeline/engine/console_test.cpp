// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/console.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/events.h"
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

TEST(Console, SaysHowManyCoresWereBusy) {
  EXPECT_EQ(UsageText({329, 361.9, 800, 2}), "5 min 29 s, 1.1 of 2 cores busy");
  EXPECT_EQ(CoresText({10, 0.1, 0, 16}), "0.0 of 16 cores");
  EXPECT_EQ(CoresText({10, 10, 0, 1}), "1.0 of 1 core");
  EXPECT_EQ(CoresText({329, 361.9, 800, 0}), "");  // a manifest of an older program
  EXPECT_EQ(UsageText({329, 361.9, 800, 0}), "5 min 29 s");
  EXPECT_EQ(UsageText({0.01, 0.01, 800, 2}), "0.0 s");
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
