// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/stages.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

TEST(Stages, KnowWhatTheyNeed) {
  const FakeSurvey fake;
  EXPECT_THAT(WithNeeds(fake.table, "dense"), ElementsAre("ingest", "calib", "dense"));
  EXPECT_EQ(FindProblem(fake.table), "");
  EXPECT_EQ(&GetStage(fake.table, "calib"), &fake.table[1]);
  EXPECT_THROW(GetStage(fake.table, "nothing"), Error);
}

TEST(Stages, ATableInTheWrongOrderIsFound) {
  FakeSurvey fake;
  std::swap(fake.table[0], fake.table[1]);
  EXPECT_THAT(FindProblem(fake.table), HasSubstr("calib needs ingest"));
  fake.table = {fake.table[1], fake.table[1]};
  EXPECT_THAT(FindProblem(fake.table), HasSubstr("listed twice"));
}

}  // namespace
}  // namespace stucco
