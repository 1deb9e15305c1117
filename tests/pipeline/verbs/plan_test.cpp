// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/plan.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

using testing::HasSubstr;

// What planning makes is tested in tests/plan; here is what it refuses before it begins.
class PlanSurveyTest : public testing::Test {
 protected:
  Error Refused(const std::filesystem::path& survey, const PlanRequest& request) {
    std::FILE* file = std::tmpfile();
    Console console(file, false, Verbosity::kQuiet);
    Error error(ErrorKind::kInterrupted, "was not refused");
    try {
      PlanSurvey(survey, request, fake.table, console, fake.platform);
    } catch (const Error& e) {
      error = e;
    }
    std::fclose(file);
    return error;
  }

  FakeSurvey fake;
};

TEST_F(PlanSurveyTest, AllWrongOptionsAreSaidAtOnce) {
  PlanRequest request;
  request.set = {"gsd_m=-1", "no_such_option=2"};
  const Error error = Refused(fake.root / "new", request);
  EXPECT_EQ(error.kind(), ErrorKind::kUsage);
  EXPECT_THAT(error.what(), HasSubstr("gsd_m"));
  EXPECT_THAT(error.what(), HasSubstr("no_such_option"));
  EXPECT_EQ(Refused("", {}).kind(), ErrorKind::kUsage);
}

TEST_F(PlanSurveyTest, ABadMapLeavesNoSurveyBehind) {
  PlanRequest request;
  request.map = fake.root / "none.geojson";
  EXPECT_THAT(Refused(fake.root / "new", request).what(), HasSubstr("none.geojson"));
  WriteFile(request.map, "no map at all");
  EXPECT_EQ(Refused(fake.root / "new", request).kind(), ErrorKind::kBadInput);
  EXPECT_FALSE(std::filesystem::exists(fake.root / "new"));
}

TEST(PlanOptions, AreTheOnesThatASurveyTakes) {
  std::set<std::string> names;
  ForPlanOptions([&](const Option& option) { names.insert(option.name); });
  EXPECT_TRUE(names.contains("gsd_m"));
  EXPECT_TRUE(names.contains("method"));
}

}  // namespace
}  // namespace stucco
