// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/outputs.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "pipeline/engine/work_folder.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using Stages = std::set<std::string>;

TEST(Outputs, WorkWithoutTheExchangeOperation) {
  FakeSurvey fake;
  fake.platform = WithoutExchange();
  fake.Run();
  fake.SetOption("side.size", "9");
  EXPECT_EQ(fake.Run().exit_code, 0);
  EXPECT_THAT(fake.Outputs().at("side/result.txt"), HasSubstr("size 9"));
  EXPECT_TRUE(FilesBelow(WorkFolder(fake.survey).Scratch()).empty());
}

TEST(Outputs, AreRestoredAfterAKillInTheMiddleOfAReplacement) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  const fs::path scratch = WorkFolder(fake.survey).Scratch();
  fs::create_directories(scratch / "dense-77");
  WriteFile(scratch / "dense-77/half.txt", "half");
  fs::rename(fake.survey / "side", scratch / "side-77.old");
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), Stages());
  EXPECT_EQ(fake.Outputs(), outputs);
  EXPECT_TRUE(FilesBelow(scratch).empty());
}

TEST(Outputs, OfAnEpochAreRestoredLikewise) {
  FakeSurvey fake;
  fake.Run();
  const fs::path scratch = WorkFolder(fake.survey).Scratch();
  fs::create_directories(scratch / "epochs/may-77.old");
  WriteFile(scratch / "epochs/may-77.old/retexture.json", "{}");
  fs::create_directories(fake.survey / "epochs");
  fs::create_directories(scratch / "epochs/june-78");
  fake.Run();
  EXPECT_EQ(ReadFile(fake.survey / "epochs/may/retexture.json"), "{}");
  EXPECT_FALSE(fs::exists(fake.survey / "epochs/june"));
  EXPECT_TRUE(FilesBelow(scratch).empty());
}

TEST(Outputs, NeverReplaceAFolderOfTheUser) {
  for (const Platform& platform : {RealPlatform(), WithoutExchange()}) {
    FakeSurvey fake;
    fake.platform = platform;
    fs::create_directories(fake.survey / "calib/mine");
    WriteFile(fake.survey / "calib/mine/thesis.txt", "years of work");
    fs::create_directories(fake.survey / "calib.old-1");
    WriteFile(fake.survey / "report", "a file");
    EXPECT_EQ(fake.Run().exit_code, 0);
    auto outputs = fake.Outputs();
    EXPECT_EQ(outputs.at("calib.old-2/mine/thesis.txt"), "years of work");
    EXPECT_EQ(outputs.at("report.old-1"), "a file");
    EXPECT_EQ(outputs.count("calib/mine/thesis.txt"), 0u);
    EXPECT_THAT(fake.log, HasSubstr("calib was not made by stucco and is now"));
    fake.SetOption("calib.size", "2");
    EXPECT_EQ(fake.Run().exit_code, 0);
    EXPECT_FALSE(fs::exists(fake.survey / "calib.old-3"));
  }
}

TEST(Outputs, OfARunThatWasKilledBeforeItsManifestAreReplaced) {
  FakeSurvey fake;
  fake.Run();
  const auto outputs = fake.Outputs();
  fs::remove(WorkFolder(fake.survey).Manifest("calib"));
  EXPECT_EQ(FakeSurvey::Ran(fake.Run()), (Stages{"calib"}));
  EXPECT_EQ(fake.Outputs(), outputs);
}

}  // namespace
}  // namespace stucco
