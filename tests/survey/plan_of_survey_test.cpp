// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_of_survey.h"

#include <gtest/gtest.h>

#include "survey/files.h"
#include "survey/survey_folder.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

class Warnings : public Progress {
 public:
  void Begin(std::string_view, size_t) override {}
  void Advance(size_t) override {}
  void Warn(std::string_view text) override { texts.emplace_back(text); }
  void Note(std::string_view) override {}
  bool Cancelled() const override { return false; }

  std::vector<std::string> texts;
};

class PlanOfSurveyTest : public testing::Test {
 protected:
  PlanOfSurveyTest() {
    std::filesystem::create_directories(folder_.path() / "plan");
    context_.survey = folder_.path();
    context_.progress = &warnings_;
  }

  test::TemporaryFolder folder_;
  Warnings warnings_;
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
  EXPECT_TRUE(warnings_.texts.empty());
}

TEST_F(PlanOfSurveyTest, IsSilentWithoutAPlan) {
  EXPECT_FALSE(PlanOfSurvey(context_));
  EXPECT_TRUE(warnings_.texts.empty());
}

TEST_F(PlanOfSurveyTest, WarnsAboutAPlanThatCannotBeRead) {
  for (const char* text : {"", "{", "{\"version\": 1}"}) {
    warnings_.texts.clear();
    WriteFile(folder_.path() / kPlanFile, text);
    EXPECT_FALSE(PlanOfSurvey(context_));
    ASSERT_EQ(warnings_.texts.size(), 1u);
    EXPECT_NE(warnings_.texts[0].find("plan.json"), std::string::npos) << warnings_.texts[0];
  }
}

}  // namespace
}  // namespace stucco
