// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>

#include "report/report_json.h"
#include "tests/report/made_survey.h"

namespace stucco {
namespace {

using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

using Json = nlohmann::json;

class Outputs : public testing::Test {
 protected:
  void Load(const MadeSurvey& made) {
    WriteSurvey(made, folder_.path());
    data_ = LoadSurvey(folder_.path(), {});
    rows_ = MakeFacetRows(data_, {});
  }

  Json Report(const ReportOptions& options = {}) {
    return Json::parse(ReportJson(data_, rows_, options));
  }

  test::TemporaryFolder folder_;
  SurveyData data_;
  std::vector<FacetRow> rows_;
};

// A reader of RFC 4180 of the test's own.
std::vector<std::vector<std::string>> ParseCsv(const std::string& text) {
  std::vector<std::vector<std::string>> lines(1, {""});
  bool quoted = false;
  for (size_t i = 0; i < text.size(); ++i) {
    const char c = text[i];
    if (quoted) {
      if (c != '"') {
        lines.back().back() += c;
      } else if (i + 1 < text.size() && text[i + 1] == '"') {
        lines.back().back() += text[++i];
      } else {
        quoted = false;
      }
    } else if (c == '"') {
      quoted = true;
    } else if (c == ',') {
      lines.back().emplace_back();
    } else if (c == '\r') {
      EXPECT_EQ(text.at(i + 1), '\n');
      ++i;
      lines.push_back({""});
    } else {
      lines.back().back() += c;
    }
  }
  EXPECT_THAT(lines.back(), ElementsAre(""));  // the last line ends
  lines.pop_back();
  return lines;
}

TEST_F(Outputs, JsonHasTheFixedNames) {
  Load(MakeSurvey());
  const Json report = Report();
  EXPECT_EQ(report["version"], 1);
  EXPECT_EQ(report["unit"], "m");
  ASSERT_EQ(report["facades"].size(), 15U);
  const Json& facade = report["facades"][0];
  EXPECT_EQ(facade["id"], "B0001/W01");
  EXPECT_EQ(facade["verdict"], "green");
  EXPECT_TRUE(facade["planned"].is_null());
  EXPECT_TRUE(report["plan"].is_null());
  for (const char* name : {"q_s", "q_d", "q_u", "q_c"}) {
    EXPECT_TRUE(facade["achieved"][name].is_number()) << name;
  }
  for (const char* name : {"gsd_m", "seen", "inferred", "inpainted", "misregistration_px"}) {
    EXPECT_TRUE(facade[name].is_number()) << name;
  }
  EXPECT_THAT(facade["photos"], SizeIs(3));
}

TEST_F(Outputs, ThePlanStandsBesideWhatWasAchieved) {
  MadeSurvey made = MakeSurvey();
  made.proxy.buildings[0].facets[0].planned_facades = {"B0007/F01"};
  WriteSurvey(made, folder_.path());
  data_ = LoadSurvey(folder_.path(), {});
  data_.plan.emplace();
  data_.plan->method = "cocapture";
  data_.plan->facades.resize(2);
  data_.plan->facades[0].id = "B0007/F00";
  data_.plan->facades[1].id = "B0007/F01";
  data_.plan->facades[1].predicted = {0.9, 0.8, 0.7, 0.95};
  rows_ = MakeFacetRows(data_, {});
  const Json report = Report();
  const Json& facade = report["facades"][0];
  EXPECT_EQ(facade["id"], "B0001/W01");
  EXPECT_EQ(facade["facade"], "B0007/F01");
  EXPECT_EQ(facade["planned"], (Json{{"q_s", 0.9}, {"q_d", 0.8}, {"q_u", 0.7}, {"q_c", 0.95}}));
  EXPECT_TRUE(facade["achieved"]["q_c"].is_number());
  EXPECT_TRUE(report["facades"][1]["planned"].is_null());
  EXPECT_EQ(report["plan"]["facades"], 2);
  EXPECT_EQ(report["plan"]["method"], "cocapture");
  EXPECT_EQ(report["plan"]["missing"], Json::array({"B0007/F00"}));
  const auto lines = ParseCsv(FacadesCsv(data_, rows_));
  const auto column = [&](const char* name) {
    return std::ranges::find(lines[0], name) - lines[0].begin();
  };
  ASSERT_LT(column("planned_q_c"), static_cast<long>(lines[0].size()));
  EXPECT_EQ(lines[1][column("planned_q_s")], "0.9");
  EXPECT_EQ(lines[1][column("planned_q_c")], "0.95");
  EXPECT_EQ(lines[2][column("planned_q_s")], "");
}

TEST_F(Outputs, JsonSaysWhatIsNotKnown) {
  MadeSurvey made = MakeSurvey();
  made.textures.facets[0].image.clear();
  made.textures.facets[1].misregistration_px = -1;
  Load(made);
  const Json report = Report();
  EXPECT_TRUE(report["facades"][0]["achieved"].is_null());
  EXPECT_TRUE(report["facades"][0]["gsd_m"].is_null());
  EXPECT_EQ(report["facades"][0]["verdict"], "red");
  EXPECT_TRUE(report["facades"][1]["misregistration_px"].is_null());
}

TEST_F(Outputs, JsonHasTheSurvey) {
  Load(MakeSurvey());
  const Json report = Report();
  EXPECT_EQ(report["photos"]["total"], 24);
  EXPECT_EQ(report["photos"]["usable"], 22);
  EXPECT_EQ(report["photos"]["posed"], 21);
  EXPECT_THAT(report["photos"]["left_out"], SizeIs(3));
  EXPECT_DOUBLE_EQ(report["calibration"]["prior_rms_m"]["horizontal"], 0.043);
  EXPECT_EQ(report["verdicts"]["walls"]["total"], 12);
  EXPECT_EQ(report["verdicts"]["all"]["total"], 15);
  EXPECT_EQ(report["georef"]["frame"], "enu");
  EXPECT_DOUBLE_EQ(report["limits"]["coverage_red_below"], 0.6);
}

TEST_F(Outputs, JsonOfNothing) {
  data_ = LoadSurvey(folder_.path(), {});
  const Json report = Report();
  EXPECT_THAT(report["facades"], SizeIs(0));
  EXPECT_TRUE(report["calibration"].is_null());
  EXPECT_TRUE(report["photos"]["total"].is_null());
  EXPECT_THAT(report["attention"], SizeIs(5));
  EXPECT_THAT(ParseCsv(FacadesCsv(data_, rows_)), SizeIs(1));
}

TEST_F(Outputs, TimesAreThereOnlyOnRequest) {
  Load(MakeSurvey());
  data_.statuses[0].wall_s = 12.5;
  EXPECT_FALSE(Report()["stages"][0].contains("wall_s"));
  const Json timed = Report({.record_times = true});
  EXPECT_DOUBLE_EQ(timed["stages"][0]["wall_s"], 12.5);
  EXPECT_TRUE(timed["stages"][0]["cpu_s"].is_null());
}

TEST_F(Outputs, JsonSurvivesBytesThatAreNoText) {
  Load(MakeSurvey());
  data_.calibration->unposed.push_back({"bad \xff.jpg", "\x80"});
  const Json report = Report();
  EXPECT_EQ(report["photos"]["left_out"][0]["path"], "bad \xEF\xBF\xBD.jpg");
}

TEST_F(Outputs, CsvHasALinePerFacade) {
  Load(MakeSurvey());
  const auto lines = ParseCsv(FacadesCsv(data_, rows_));
  ASSERT_EQ(lines.size(), 16U);
  EXPECT_EQ(lines[0][0], "id");
  EXPECT_THAT(lines, Each(SizeIs(lines[0].size())));
  EXPECT_EQ(lines[1][0], "B0001/W01");
  EXPECT_EQ(lines[1][3], "WallSurface");
  EXPECT_EQ(lines[1][4], "green");
  EXPECT_EQ(lines[1][6], "m");
}

TEST_F(Outputs, CsvQuotesNames) {
  MadeSurvey made = MakeSurvey();
  const std::string hostile = "a,\"b\"\r\nc";
  made.proxy.buildings[0].facets[0].planned_facades = {hostile};
  Load(made);
  const auto lines = ParseCsv(FacadesCsv(data_, rows_));
  ASSERT_EQ(lines.size(), 16U);
  EXPECT_THAT(lines[1], SizeIs(lines[0].size()));
  EXPECT_EQ(lines[1][2], "a,\"b\"\xEF\xBF\xBD\nc");  // a carriage return is no text
}

TEST_F(Outputs, UnitsAreNamedWhenNotMetric) {
  Load(MakeSurvey({.metric = false}));
  EXPECT_EQ(Report()["unit"], "units");
  EXPECT_EQ(ParseCsv(FacadesCsv(data_, rows_))[1][6], "units");
}

}  // namespace
}  // namespace stucco
