// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/run.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;

// FakeSurvey::Run is RunSurvey.

TEST(RunSurvey, WarnsAndGoesOn) {
  FakeSurvey fake;
  fake.table[1].cost.memory_mb = 1e9;
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THAT(fake.log, HasSubstr("warning: calib will need about"));
  EXPECT_EQ(fake.Events("warning").size(), 1u);
  EXPECT_EQ(fake.Events("run_done").size(), 1u);
}

TEST(RunSurvey, SaysAlsoWhatIsNotFatalBeforeItStops) {
  FakeSurvey fake;
  fake.table[1].cost.memory_mb = 1e9;
  fake.table[1].cost.disk_mb_per_megapixel = 1e15;
  EXPECT_THROW(fake.Run(), Error);
  EXPECT_THAT(fake.log, HasSubstr("warning: calib will need about"));
  EXPECT_TRUE(fake.Outputs().empty());
}

TEST(RunSurvey, AForcedRunThatIsRefusedForgetsNothing) {
  FakeSurvey fake;
  fake.Run();
  fake.table[1].cost.disk_mb_per_megapixel = 1e15;
  std::filesystem::rename(fake.survey / "calib", fake.root / "calib");
  RunOptions force;
  force.force = true;
  EXPECT_THROW(fake.Run(force), Error);
  std::filesystem::rename(fake.root / "calib", fake.survey / "calib");
  EXPECT_EQ(StateOf(fake.Status(), "calib"), "done");
}

TEST(RunSurvey, LooksOnlyAtTheStagesThatWereAskedFor) {
  FakeSurvey fake;
  fake.table[3].cost.disk_mb_per_megapixel = 1e15;
  RunOptions options;
  options.until = "calib";
  EXPECT_EQ(fake.Run(options).exit_code, 0);
  EXPECT_THROW(fake.Run(), Error);
}

}  // namespace
}  // namespace stucco
