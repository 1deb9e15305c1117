// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_of_survey.h"

#include <gtest/gtest.h>

#include "survey/files.h"
#include "survey/plan_io.h"
#include "survey/survey_folder.h"
#include "tests/survey/stage_support.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

class PlanOfSurveyTest : public testing::Test {
 protected:
  PlanOfSurveyTest() {
    std::filesystem::create_directories(folder_.path() / "plan");
    context_.survey = folder_.path();
    context_.progress = &listener_;
  }

  test::TemporaryFolder folder_;
  test::Listener listener_;
  StageContext context_;
};

TEST_F(PlanOfSurveyTest, ReadsThePlan) {
  Plan plan;
  plan.method = "cocapture";
  plan.crs = "+proj=tmerc";
  plan.d_min_m = 10;
  WritePlan(plan, folder_.path() / kPlanFile);
  const auto read = PlanOfSurvey(context_);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->method, "cocapture");
  EXPECT_TRUE(listener_.warnings.empty());
}

TEST_F(PlanOfSurveyTest, IsSilentWithoutAPlan) {
  EXPECT_FALSE(PlanOfSurvey(context_));
  EXPECT_TRUE(listener_.warnings.empty());
}

TEST_F(PlanOfSurveyTest, WarnsAboutAPlanThatCannotBeRead) {
  for (const char* text : {"", "{", "{\"version\": 1}"}) {
    listener_.warnings.clear();
    WriteFile(folder_.path() / kPlanFile, text);
    EXPECT_FALSE(PlanOfSurvey(context_));
    ASSERT_EQ(listener_.warnings.size(), 1u);
    EXPECT_NE(listener_.warnings[0].find("plan.json"), std::string::npos) << listener_.warnings[0];
  }
}

}  // namespace
}  // namespace stucco
