// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/status.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/survey_folder.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;

TEST(Status, SaysWhatToTypeNext) {
  FakeSurvey fake;
  EXPECT_EQ(fake.Status().next, "stucco run " + fake.survey.string());
  EXPECT_EQ(StateOf(fake.Status(), "dense"), "missing");
  fake.Run();
  EXPECT_EQ(fake.Status().next, "open " + (fake.survey / kReportFile).string());
  fake.during = [](const std::string& stage, StageContext&) {
    if (stage == "calib") throw Error(ErrorKind::kStageFailed, "too dark", "take them by day");
  };
  fake.SetOption("calib.size", "2");
  fake.Run();
  EXPECT_EQ(fake.Status().next, "take them by day, then: stucco run " + fake.survey.string());
}

TEST(Status, NamesWhoIsAtWork) {
  FakeSurvey fake;
  const SurveyLock lock(fake.survey, "stucco run there", RealPlatform());
  const SurveyStatus status = fake.Status();
  ASSERT_TRUE(status.running);
  EXPECT_EQ(status.running->command, "stucco run there");
  EXPECT_THAT(status.next, HasSubstr("wait: process"));
}

TEST(Status, KnowsWhatEachStageTook) {
  FakeSurvey fake;
  EXPECT_EQ(UsageOf(fake.Status().stages[1].assessment), nullptr);
  const RunResult result = fake.Run();
  const SurveyStatus status = fake.Status();
  const Usage* usage = UsageOf(status.stages[1].assessment);
  ASSERT_NE(usage, nullptr);
  EXPECT_NEAR(usage->cpu_s, OutcomeOf(result, "calib").usage.cpu_s, 1e-3);
  EXPECT_EQ(usage->cores, AvailableCores());
}

}  // namespace
}  // namespace stucco
