// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "pipeline/engine/settings.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "survey/error.h"
#include "survey/files.h"
#include "tests/pipeline/fake_survey.h"

namespace stucco {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

struct AllKinds {
  int count = 3;
  double share = 0.25;
  bool on = true;
  std::string mode = "auto";
  std::string name = "a \"quoted\" one";
  std::vector<double> matrix = {1, 2.5};
};

void DescribeAllKinds(OptionTable& table, AllKinds& options) {
  table.Add("count", options.count, 1, 64, "How many.");
  table.Add("share", options.share, 0, 1, "Share of the area.");
  table.Add("on", options.on, "Whether.");
  table.Add("mode", options.mode, {"auto", "gps"}, "Which way | <b>.");
  table.Add("name", options.name, {}, "Any text.");
  table.Add("matrix", options.matrix, "Numbers.");
}

class SettingsTest : public testing::Test {
 protected:
  SettingsTest() {
    Stage stage;
    stage.name = "calib";
    stage.title = "camera poses";
    stage.bind = [this] {
      BoundStage bound{OptionTable("calib"), nullptr};
      DescribeAllKinds(bound.options, values);
      return bound;
    };
    table = {stage};
  }

  Settings Load(const std::string& text, const std::vector<std::string>& overrides = {}) {
    WriteFile(fake.survey / "survey.toml", text);
    return LoadSettings(fake.survey, table, overrides);
  }

  Error Refused(const std::string& text, const std::vector<std::string>& overrides = {}) {
    try {
      Load(text, overrides);
    } catch (const Error& e) {
      return e;
    }
    return Error(ErrorKind::kInterrupted, "was not refused");
  }

  FakeSurvey fake;
  AllKinds values;
  StageTable table;
};

TEST_F(SettingsTest, EveryKindOfValueIsRead) {
  Load(
      "photos = \"/p\"\n[run]\nthreads = 2\n[calib]\ncount = 5\nshare = 1\non = false\n"
      "mode = \"gps\"\nname = \"x\"\nmatrix = [3, 4.5]\n");
  EXPECT_EQ(values.count, 5);
  EXPECT_EQ(values.share, 1);
  EXPECT_FALSE(values.on);
  EXPECT_EQ(values.mode, "gps");
  EXPECT_EQ(values.name, "x");
  EXPECT_EQ(values.matrix, (std::vector<double>{3, 4.5}));
}

TEST_F(SettingsTest, OverridesStandAboveTheFile) {
  Load("photos = \"/p\"\n[calib]\ncount = 5\n", {"calib.count=6", "calib.matrix=1,2"});
  EXPECT_EQ(values.count, 6);
}

TEST_F(SettingsTest, AllProblemsAreSaidAtOnceWithLineAndSuggestion) {
  const Error error = Refused(
      "photos = 3\n[calib]\ncoumt = 5\nshare = 7.5\non = \"yes\"\nmode = \"gsp\"\n"
      "matrix = [1, \"a\"]\nname = 1979-05-27\n[clib]\nx = 1\n[run]\nthreads = -1\n",
      {"calib.modee=auto", "nonsense", "calbi.count=3", "calib.count=many"});
  EXPECT_EQ(error.kind(), ErrorKind::kUsage);
  const std::string what = error.what();
  EXPECT_THAT(what, HasSubstr("survey.toml:1: photos must be the path"));
  EXPECT_THAT(what, HasSubstr("survey.toml:3: calib.coumt: unknown option; did you mean"));
  EXPECT_THAT(what, HasSubstr("survey.toml:4: calib.share = 7.5 must be in [0, 1]"));
  EXPECT_THAT(what, HasSubstr("survey.toml:5: calib.on"));
  EXPECT_THAT(what, HasSubstr("survey.toml:6: calib.mode"));
  EXPECT_THAT(what, HasSubstr("survey.toml:7: calib.matrix"));
  EXPECT_THAT(what, HasSubstr("survey.toml:8: calib.name"));
  EXPECT_THAT(what, HasSubstr("survey.toml:9: clib: unknown section; did you mean calib?"));
  EXPECT_THAT(what, HasSubstr("survey.toml:12: run.threads"));
  EXPECT_THAT(what, HasSubstr("--set calib.modee=auto: calib.modee: unknown option"));
  EXPECT_THAT(what, HasSubstr("--set nonsense: must look like"));
  EXPECT_THAT(what, HasSubstr("--set calbi.count=3: calbi: unknown section"));
  EXPECT_THAT(what, HasSubstr("--set calib.count=many"));
}

TEST_F(SettingsTest, ASectionMustBeOneAndPhotosMustBeThere) {
  const Error error = Refused("calib = 3\n");
  EXPECT_THAT(error.what(), HasSubstr("survey.toml:1: calib must be a section"));
  EXPECT_THAT(error.what(), HasSubstr("photos is missing"));
}

TEST_F(SettingsTest, WhatIsNoTomlIsBadInputWithItsLine) {
  const Error error = Refused("photos = \"p\"\n[calib\n");
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput);
  EXPECT_THAT(error.what(), HasSubstr("survey.toml:2: is not valid TOML"));
}

TEST_F(SettingsTest, WithoutSurveyTomlItSaysHowToMakeOne) {
  fs::remove(fake.survey / "survey.toml");
  try {
    LoadSettings(fake.survey, table, {});
    FAIL();
  } catch (const Error& e) {
    EXPECT_EQ(e.kind(), ErrorKind::kBadInput);
    EXPECT_THAT(e.remedy(), HasSubstr("stucco init"));
  }
}

TEST_F(SettingsTest, TheTemplateReadsBackToTheDefaults) {
  const std::string text = SettingsTemplate(table, "../pho\"tos");
  EXPECT_THAT(text, HasSubstr("# How many. (1 to 64)\ncount = 3\n"));
  EXPECT_THAT(text, HasSubstr("threads = 0"));
  const Settings settings = Load(text);
  EXPECT_EQ(settings.photos, (fake.root / "pho\"tos"));
  EXPECT_EQ(settings.run.memory_limit_gb, 4);
  const AllKinds defaults;
  EXPECT_EQ(values.count, defaults.count);
  EXPECT_EQ(values.name, defaults.name);
  EXPECT_EQ(values.matrix, defaults.matrix);
}

TEST_F(SettingsTest, MarkdownKeepsItsTable) {
  const std::string text = OptionsAsMarkdown(table);
  EXPECT_THAT(text, HasSubstr("| `count` | `3` | 1 to 64 | How many. |"));
  EXPECT_THAT(text, HasSubstr("Which way \\| &lt;b>."));
  EXPECT_THAT(text, HasSubstr("Changes no result."));
}

}  // namespace
}  // namespace stucco
