// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/survey_data.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <fstream>

#include "survey/survey_folder.h"
#include "tests/report/made_survey.h"

namespace stucco {
namespace {

using testing::ElementsAre;
using testing::Field;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

StageStatus Status(std::string stage, std::string state, std::string why = {}) {
  StageStatus status;
  status.stage = std::move(stage);
  status.state = std::move(state);
  status.why = std::move(why);
  return status;
}

TEST(LoadSurvey, ReadsEverything) {
  const test::TemporaryFolder folder;
  WriteSurvey(MakeSurvey(), folder.path());
  const SurveyData data = LoadSurvey(folder.path(), {Status("ingest", "done")});
  EXPECT_TRUE(data.captures && data.calibration && data.georef && data.proxy && data.textures);
  EXPECT_EQ(data.photos.size(), 19U);
  EXPECT_THAT(data.damaged, IsEmpty());
  EXPECT_TRUE(data.metric);
  EXPECT_THAT(FindAttention(data), IsEmpty());
}

TEST(LoadSurvey, AnEmptyFolderIsASurveyThatHasNotRun) {
  const test::TemporaryFolder folder;
  const SurveyData data = LoadSurvey(folder.path(), {});
  EXPECT_FALSE(data.captures || data.calibration || data.proxy || data.textures);
  EXPECT_FALSE(data.metric);
  const auto attention = FindAttention(data);
  ASSERT_EQ(attention.size(), 5U);
  EXPECT_EQ(attention[0].stage, "ingest");
  EXPECT_EQ(attention[0].state, "missing");
  EXPECT_EQ(attention[0].command, "stucco run SURVEY");
}

TEST(LoadSurvey, DamagedResultsAreNamedWithoutTheFolder) {
  const test::TemporaryFolder folder;
  WriteSurvey(MakeSurvey(), folder.path());
  std::ofstream(folder.path() / kFacetsFile) << "{ \"version\": 1, \"buil";
  std::ofstream(folder.path() / kSparseFolder / "images.bin") << "x";
  const SurveyData data = LoadSurvey(folder.path(), {Status("calib", "done")});
  EXPECT_FALSE(data.proxy);
  EXPECT_TRUE(data.textures);
  EXPECT_THAT(data.damaged, ElementsAre(Field(&DamagedFile::stage, "calib"),
                                        Field(&DamagedFile::stage, "proxy")));
  const auto attention = FindAttention(data);
  ASSERT_EQ(attention.size(), 2U);
  EXPECT_EQ(attention[1].state, "damaged");
  EXPECT_THAT(attention[1].why, Not(HasSubstr(folder.path().string())));
  EXPECT_THAT(attention[1].command, HasSubstr("--from proxy"));
}

TEST(LoadSurvey, IsMetricOnlyWhenNothingContradicts) {
  for (const bool georef : {false, true}) {
    for (const bool proxy : {false, true}) {
      const test::TemporaryFolder folder;
      MadeSurvey made = MakeSurvey();
      made.georef.metric = georef;
      made.proxy.metric = proxy;
      WriteSurvey(made, folder.path());
      EXPECT_EQ(LoadSurvey(folder.path(), {}).metric, georef && proxy);
    }
  }
}

TEST(FindAttention, FailuresComeFirst) {
  SurveyData data;
  data.statuses = {Status("ingest", "done"), Status("calib", "stale", "calib.max_features changed"),
                   Status("dense", "failed", "no memory"), Status("proxy", "missing")};
  const auto attention = FindAttention(data);
  ASSERT_EQ(attention.size(), 3U);
  EXPECT_EQ(attention[0].stage, "dense");
  EXPECT_EQ(attention[0].why, "no memory");
  EXPECT_EQ(attention[1].stage, "proxy");
  EXPECT_EQ(attention[2].stage, "calib");
}

TEST(LoadSurvey, TheReportDoesNotReportItself) {
  const test::TemporaryFolder folder;
  const SurveyData data = LoadSurvey(folder.path(), {Status("report", "missing")});
  EXPECT_THAT(data.statuses, IsEmpty());
}

TEST(LeftOutPhotos, NamesEachOnce) {
  SurveyData data;
  data.captures.emplace();
  data.captures->photos.resize(3);
  data.captures->photos[0].path = "c.jpg";
  data.captures->photos[0].why = "empty";
  data.captures->photos[1].path = "a.jpg";
  data.captures->photos[1].usable = true;
  data.captures->photos[2].path = "b.jpg";
  data.captures->photos[2].duplicate_of = "a.jpg";
  data.calibration.emplace();
  data.calibration->unposed = {{"a.jpg", "too few matches"}, {"c.jpg", "unusable"}};
  const auto photos = LeftOutPhotos(data);
  ASSERT_EQ(photos.size(), 3U);
  EXPECT_EQ(photos[0].path, "a.jpg");
  EXPECT_EQ(photos[0].what, "not posed");
  EXPECT_EQ(photos[1].what, "duplicate");
  EXPECT_EQ(photos[2].what, "unusable");
  EXPECT_EQ(photos[2].why, "empty");
}

}  // namespace
}  // namespace stucco
