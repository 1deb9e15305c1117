// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/progress.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/events.h"

namespace stucco {
namespace {

using testing::HasSubstr;

TEST(Progress, TextSaysCountsRateAndTimeLeft) {
  EXPECT_THAT(ProgressText("calib", "matching", 120, 480, 12),
              HasSubstr("matching 120/480 (25 %)"));
  EXPECT_THAT(ProgressText("calib", "matching", 120, 480, 12), HasSubstr("12/s, 30 s left"));
  EXPECT_THAT(ProgressText("dense", "depth", 1, 4, 0.05), HasSubstr("20 s each, 1 min 00 s left"));
  EXPECT_THAT(ProgressText("calib", "matching", 9, 4, 0), HasSubstr("4/4 (100 %)"));
  EXPECT_THAT(ProgressText("calib", "thinking", 0, 0, 0), HasSubstr("thinking"));
}

TEST(Progress, RateForgetsTheReusedUnitsOfTheBeginning) {
  RateMeter meter;
  meter.Restart(0);
  EXPECT_EQ(meter.rate(), 0);
  meter.Add(0.2, 1000);  // checkpoints, at once
  for (int second = 1; second <= 60; ++second) {
    meter.Add(second, 1000 + 2 * static_cast<size_t>(second));
  }
  EXPECT_NEAR(meter.rate(), 2, 0.1);
}

TEST(Progress, QuietShowsWarningsOnly) {
  std::FILE* file = std::tmpfile();
  EventLog no_events;
  Console console(file, true, Verbosity::kQuiet);
  {
    StageProgress progress("calib", console, no_events, [] { return false; });
    progress.Begin("matching", 3);
    progress.Advance(3);
    progress.Note("a note");
    progress.Warn("a warning");
  }
  std::rewind(file);
  char text[1000] = {};
  const size_t size = std::fread(text, 1, sizeof(text) - 1, file);
  std::fclose(file);
  EXPECT_EQ(std::string(text, size), "  calib: warning: a warning\n");
}

}  // namespace
}  // namespace stucco
