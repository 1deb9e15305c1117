// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "plan/output/stats.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

TEST(Stats, CountsWhatThePlanHolds) {
  const PlanStats stats = StatsOf(test::MakePlan(), 12.5, 0.031);
  EXPECT_EQ(stats.method, "cocapture");
  EXPECT_EQ(stats.photos, 9);
  EXPECT_EQ(stats.hovers, 3);
  EXPECT_EQ(stats.photos_by_kind,
            (std::map<std::string, int>{
                {"dipping", 3}, {"dipping_foot", 1}, {"nadir", 1}, {"oblique", 4}}));
  EXPECT_DOUBLE_EQ(stats.length_m, 371.5);
  EXPECT_DOUBLE_EQ(stats.time_min, 4.75);
  EXPECT_DOUBLE_EQ(stats.battery_percent, 18.5);
  EXPECT_EQ(stats.battery_by_flight, (std::vector<double>{12.5, 6}));
  EXPECT_EQ(stats.planning_s, 12.5);
  EXPECT_EQ(stats.tsp_gap, 0.031);
}

TEST(Stats, AveragesFacades) {
  const PlanStats stats = StatsOf(test::MakePlan(), 0, 0);
  ASSERT_EQ(stats.facades.size(), 8u);
  EXPECT_EQ(stats.facades[0].id, "B0001/F00");
  EXPECT_DOUBLE_EQ(stats.facades[0].length_m, 40);
  EXPECT_EQ(stats.facades[0].views, 2);
  EXPECT_DOUBLE_EQ(stats.wall_m, 2 * (40 + 25) + 2 * (25 + 25));
  EXPECT_DOUBLE_EQ(stats.unobservable_m, 7);
  EXPECT_DOUBLE_EQ(stats.mean.q_s, 0.9);
  EXPECT_NEAR(stats.mean.q_d, 0.3, 1e-12);
  EXPECT_NEAR(stats.mean.q_c, 1, 1e-12);
  // q_d is 0, 0.2, 0.4 and 0.6 on walls of 40, 25, 40, 25 and of four times 25 metres.
  EXPECT_NEAR(stats.mean_by_length.q_d, (0.2 * 50 + 0.4 * 65 + 0.6 * 50) / 230, 1e-12);
}

TEST(Stats, FileHasTheFixedNames) {
  const test::TemporaryFolder folder;
  WriteStats(StatsOf(test::MakePlan(), 12.34567, 0.0312345), folder / "stats.json");
  const auto json = nlohmann::json::parse(ReadFile(folder / "stats.json"));
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["method"], "cocapture");
  EXPECT_EQ(json["photos"], 9);
  EXPECT_EQ(json["hovers"], 3);
  EXPECT_EQ(json["length_m"], 371.5);
  EXPECT_EQ(json["time_min"], 4.75);
  EXPECT_EQ(json["battery_percent"], 18.5);
  EXPECT_EQ(json["flights"], 2);
  EXPECT_EQ(json["time_parts_min"]["photos"], 0.75);
  EXPECT_EQ(json["time_parts_min"]["transfer"], 1.5);
  EXPECT_EQ(json["assumed"]["speed_m_per_s"], 5.0);
  EXPECT_EQ(json["assumed"]["photo_s"], 2.2);
  EXPECT_EQ(json["assumed"]["wind_m_per_s"], 3.0);
  EXPECT_EQ(json["planning_s"], 12.346);
  EXPECT_EQ(json["tsp_gap"], 0.03123);
  EXPECT_EQ(json["unobservable_m"], 7.0);
  EXPECT_EQ(json["mean"]["q_s"], 0.9);
  ASSERT_EQ(json["facades"].size(), 8u);
  const auto& facade = json["facades"][2];
  EXPECT_EQ(facade["id"], "B0001/F02");
  EXPECT_EQ(facade["length_m"], 40.0);
  EXPECT_EQ(facade["views"], 0);
  EXPECT_EQ(facade["q_s"], 0.9);
  EXPECT_EQ(facade["q_d"], 0.4);
  EXPECT_EQ(facade["q_u"], 0.7);
  EXPECT_EQ(facade["q_c"], 1.0);
  EXPECT_EQ(facade["unobservable_m"], nlohmann::json::parse("[[1.0, 4.5]]"));
  EXPECT_FALSE(json["facades"][0].contains("unobservable_m"));
}

TEST(Stats, FileSaysWhatSafetyRestsOn) {
  const test::TemporaryFolder folder;
  PlanStats stats = StatsOf(test::MakePlan(), 1, 0);
  stats.horizontal_error_m = 3.8284;
  stats.vertical_error_m = 4.8284;
  stats.warnings = {"one", "two \"quoted\""};
  WriteStats(stats, folder / "stats.json");
  auto json = nlohmann::json::parse(ReadFile(folder / "stats.json"));
  EXPECT_EQ(json["horizontal_error_m"], 3.828);
  EXPECT_EQ(json["vertical_error_m"], 4.828);
  EXPECT_FALSE(json.contains("flat_within_m"));
  EXPECT_EQ(json["warnings"], nlohmann::json(stats.warnings));
  stats.flat_within_m = 1;
  WriteStats(stats, folder / "stats.json");
  json = nlohmann::json::parse(ReadFile(folder / "stats.json"));
  EXPECT_EQ(json["flat_within_m"], 1.0);
}

TEST(Stats, SayHowThePhotosHangTogether) {
  const test::TemporaryFolder folder;
  PlanStats stats = StatsOf(test::MakePlan(), 0, 0);
  stats.matches = {
      2,
      1,
      7,
      1,
      {{"h0001v1", 2, 1, 0.25, {"B0001/F00"}, true}, {"h0002v1", 5, 0, 1.5, {}, false}},
      3,
      {"B0004"}};
  WriteStats(stats, folder / "stats.json");
  const auto matches = nlohmann::json::parse(ReadFile(folder / "stats.json"))["matches"];
  EXPECT_EQ(matches["parts"], 2);
  EXPECT_EQ(matches["bridges"], 1);
  EXPECT_EQ(matches["hanging"], 7);
  EXPECT_EQ(matches["apart"], 3);
  EXPECT_EQ(matches["loose"], 1);
  EXPECT_EQ(matches["weakest"][0]["close"], 1);
  EXPECT_EQ(matches["weakest"][0]["facades"][0], "B0001/F00");
  EXPECT_FALSE(matches["weakest"][1].contains("facades"));
  EXPECT_NE(StatsTable(stats).find("loose photos: 1, parts: 2, bridges: 1, photos that hang "
                                   "on one hover: 7"),
            std::string::npos);
}

TEST(Stats, OfAnEmptyPlanAreZeros) {
  const test::TemporaryFolder folder;
  const PlanStats stats = StatsOf({}, 0, 0);
  WriteStats(stats, folder / "stats.json");
  const auto json = nlohmann::json::parse(ReadFile(folder / "stats.json"));
  EXPECT_EQ(json["photos"], 0);
  EXPECT_EQ(json["mean"]["q_s"], 0.0);
  EXPECT_TRUE(json["facades"].empty());
  EXPECT_NE(StatsTable(stats).find("none"), std::string::npos);
}

TEST(Stats, RefusesAFolderThatIsNot) {
  const test::TemporaryFolder folder;
  EXPECT_THROW(WriteStats({}, folder / "no" / "stats.json"), Error);
}

TEST(StatsTable, ShowsFiguresAndWorstFacades) {
  const std::string table = StatsTable(StatsOf(test::MakePlan(), 12.5, 0.031));
  for (const char* part : {"9 (3 dipping, 1 dipping_foot, 1 nadir, 4 oblique)", "372 m",
                           "4.8 min: 0.8 photos, 1.5 stops and turns, 1.0 legs, 1.5 transfer",
                           "5 m/s, 2.2 s a photo besides turns, 5.3 s a stop, wind 3 m/s",
                           "18 % of a battery, 2 flights of 6 to 12 %", "3.1 % above",
                           "mean Q 2.90 of 4", "7.0 of 230.0 m of wall, on 2 facades"}) {
    EXPECT_NE(table.find(part), std::string::npos) << part << " is not in\n" << table;
  }
  Plan plan = test::MakePlan();
  plan.facades[0].unobservable_m = {{0, 39}};
  EXPECT_EQ(StatsTable(StatsOf(plan, 0, 0)).find("B0001/F00"), std::string::npos);  // hidden
  // The worst comes first: q_d is lowest on the first wall of each building.
  const size_t worst = table.find("worst facades");
  EXPECT_LT(table.find("B0002/F00", worst), table.find("B0001/F01", worst));
  for (size_t begin = 0; begin < table.size(); begin = table.find('\n', begin) + 1) {
    EXPECT_LE(table.find('\n', begin) - begin, 100u);
  }
}

}  // namespace
}  // namespace stucco::plan
