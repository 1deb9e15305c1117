// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/simulate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/status.h"
#include "pipeline/verbs/init.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class SimulatedSurveyTest : public testing::Test {
 protected:
  // What it tells when it cannot be opened; empty when it can.
  std::string Refusal(const fs::path& survey) {
    try {
      const SimulatedSurvey open(survey, fake.table, "simulate", console, fake.platform);
    } catch (const Error& e) {
      EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
      return e.what();
    }
    return "";
  }
  ~SimulatedSurveyTest() override { std::fclose(file_); }

 private:
  std::FILE* file_ = std::tmpfile();

 protected:
  FakeSurvey fake;
  Console console{file_, false, Verbosity::kQuiet};
};

TEST_F(SimulatedSurveyTest, MakesASurveyThatWaitsForItsPhotosAndHoldsIt) {
  const fs::path survey = fake.root / "flown";
  {
    SimulatedSurvey open(survey, fake.table, "stucco simulate town", console, fake.platform);
    EXPECT_TRUE(fs::is_directory(survey / kWaitingPhotos));
    const SurveyStatus status = GetStatus(survey, fake.table, fake.platform);
    ASSERT_TRUE(status.running);
    EXPECT_EQ(status.running->command, "stucco simulate town");
    EXPECT_THAT(Refusal(survey), HasSubstr("another run is at work"));
    open.progress().Begin("taking photos", 1);
    open.progress().Advance(1);
    EXPECT_FALSE(open.progress().Cancelled());
    fake.interrupted = true;
    EXPECT_TRUE(open.progress().Cancelled());
  }
  EXPECT_FALSE(GetStatus(survey, fake.table, fake.platform).running);
  EXPECT_THAT(ReadFile(survey / ".stucco/events.ndjson"), HasSubstr("taking photos"));
}

TEST_F(SimulatedSurveyTest, RefusesASurveyWhosePhotosAreElsewhere) {
  EXPECT_THAT(Refusal(fake.survey), HasSubstr("its photos are in " + fake.photos.string()));
  EXPECT_FALSE(fs::exists(fake.survey / ".stucco/lock"));
}

}  // namespace
}  // namespace stucco
