// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/verbs/init.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(Init, WritesASurveyThatRuns) {
  FakeSurvey fake;
  const fs::path survey = fake.root / "new";
  EXPECT_EQ(InitSurvey(survey, fake.photos, fake.table).photos, 4u);
  fake.survey = survey;
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THROW(InitSurvey(survey, fake.photos, fake.table), Error);  // nothing is overwritten
}

TEST(Init, NamesPhotosInsideTheSurveyRelatively) {
  FakeSurvey fake;
  const fs::path survey = fake.root / "own";
  fs::create_directories(survey);
  fs::rename(fake.photos, survey / "photos");
  InitSurvey(survey, survey / "photos", fake.table);
  EXPECT_THAT(ReadFile(survey / "survey.toml"), HasSubstr("photos = \"photos\"\n"));
}

TEST(Init, RefusesWithoutLeavingAnythingBehind) {
  FakeSurvey fake;
  const auto refused = [&](const fs::path& survey, const fs::path& photos) {
    try {
      InitSurvey(survey, photos, fake.table);
    } catch (const Error& e) {
      return std::string(e.what());
    }
    return std::string("was not refused");
  };
  EXPECT_THAT(refused(fake.root / "a", fake.root / "none"), HasSubstr("is not there"));
  EXPECT_THAT(refused(fake.root / "a", fake.photos / "p0.jpg"), HasSubstr("is a file"));
  EXPECT_THAT(refused(fake.photos / "a", fake.photos), HasSubstr("inside the photo folder"));
  EXPECT_THAT(refused(fake.photos, fake.photos), HasSubstr("inside the photo folder"));
  fs::rename(fake.photos, fake.root / "\xff");
  EXPECT_THAT(refused(fake.root / "a", fake.root / "\xff"), HasSubstr("is not valid UTF-8"));
  fs::rename(fake.root / "\xff", fake.photos);
  EXPECT_THAT(refused(fake.photos / "p0.jpg", fake.photos), HasSubstr("is a file"));
  for (const char* taken : {"own/ingest", "own/calib/deep", "own/.stucco"}) {
    fs::create_directories(fake.root / taken);
    fs::copy(fake.photos, fake.root / taken);
    EXPECT_THAT(refused(fake.root / "own", fake.root / taken), HasSubstr("which a run replaces"));
    fs::create_directory_symlink(fake.root / taken, fake.root / "link");
    EXPECT_THAT(refused(fake.root / "own", fake.root / "link"), HasSubstr("which a run replaces"));
    fs::remove(fake.root / "link");
  }
  EXPECT_THAT(refused(fake.root / "own", fake.photos), HasSubstr("already has an entry ingest"));
  EXPECT_FALSE(fs::exists(fake.root / "own/survey.toml"));
  EXPECT_FALSE(fs::exists(fake.root / "a"));
  EXPECT_FALSE(fs::exists(fake.photos / "survey.toml"));
}

}  // namespace
}  // namespace stucco
