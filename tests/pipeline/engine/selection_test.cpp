// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/selection.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;
using testing::IsEmpty;

TEST(Selection, WithoutWordsIsTheWholeTable) {
  const FakeSurvey fake;
  const Selection selection = Select(fake.table, {});
  EXPECT_THAT(selection.stages, ElementsAre("ingest", "calib", "side", "dense", "report"));
  EXPECT_THAT(selection.forced, IsEmpty());
  EXPECT_THAT(selection.before_first, IsEmpty());
}

TEST(Selection, UntilTakesOnlyWhatItNeeds) {
  const FakeSurvey fake;
  RunOptions options;
  options.until = "dense";
  EXPECT_THAT(Select(fake.table, options).stages, ElementsAre("ingest", "calib", "dense"));
}

TEST(Selection, FromTakesTheStagesBeforeItAsTheyAre) {
  const FakeSurvey fake;
  RunOptions options;
  options.from = "side";
  const Selection selection = Select(fake.table, options);
  EXPECT_THAT(selection.stages, ElementsAre("side", "dense", "report"));
  EXPECT_TRUE(selection.IsBeforeFirst("calib"));
  EXPECT_FALSE(selection.IsBeforeFirst("side"));
  EXPECT_FALSE(selection.Contains("calib"));
}

TEST(Selection, ForceIsOfTheGoalAloneOrOfAllThatIsChosen) {
  const FakeSurvey fake;
  RunOptions options;
  options.force = true;
  options.goal = "dense";
  const Selection goal = Select(fake.table, options);
  EXPECT_THAT(goal.stages, ElementsAre("ingest", "calib", "dense"));
  EXPECT_THAT(goal.forced, ElementsAre("dense"));
  options.goal.clear();
  options.from = "dense";
  EXPECT_THAT(Select(fake.table, options).forced, ElementsAre("dense", "report"));
  EXPECT_TRUE(Select(fake.table, options).IsForced("report"));
}

TEST(Selection, RefusesWhatIsNoOrderAndNoStage) {
  const FakeSurvey fake;
  RunOptions options;
  options.from = "dense";
  options.until = "calib";
  try {
    Select(fake.table, options);
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kUsage);
    EXPECT_THAT(e.what(), HasSubstr("--from dense comes after --until calib"));
  }
  options.from = "nothing";
  EXPECT_THROW(Select(fake.table, options), Error);
}

}  // namespace
}  // namespace stucco
