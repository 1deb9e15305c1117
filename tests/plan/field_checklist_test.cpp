// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <pugixml.hpp>
#include <regex>

#include "plan/field/checklist.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

struct Sheet {
  Plan plan = test::MakePlan();
  PlanStats stats = StatsOf(plan, 1, 0.02);
  FieldFacts facts = {FactsOf(plan, {}), {}, SunDays(""), {}};

  std::string Html() const { return ChecklistHtml(plan, stats, facts); }
};

// All text of the elements that a path selects, one by one.
std::vector<std::string> Texts(const std::string& html, const char* path) {
  pugi::xml_document xml;
  const auto read = xml.load_string(html.c_str());
  EXPECT_TRUE(read) << read.description() << " at " << html.substr(read.offset, 80);
  std::vector<std::string> texts;
  for (const auto& found : xml.select_nodes(path)) {
    std::string text;
    for (const auto& piece : found.node().select_nodes(".//text()")) text += piece.node().value();
    texts.push_back(text);
  }
  return texts;
}

bool HasNoNumber(const std::string& html) {
  return std::regex_search(html, std::regex("\\b(nan|inf)\\b"));
}

TEST(Checklist, IsWellFormedAndNeedsNothingElse) {
  const std::string html = Sheet().Html();
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  EXPECT_EQ(Texts(html, "/html/body").size(), 1u);
  EXPECT_EQ(Texts(html, "//section").size(), 6u);
  for (const char* outside : {"<script", "http:", "https:", "src=", "href=", "@import", "url("}) {
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  }
  EXPECT_NE(html.find("size:A4"), std::string::npos);
  EXPECT_FALSE(HasNoNumber(html));
}

TEST(Checklist, EscapesWhatOthersWrote) {
  Sheet sheet;
  sheet.plan.facades[0].id = "<b>&\"F00";
  sheet.stats.camera = "Cam <1> & more";
  sheet.stats.warnings = {"mind the <crane> & wires"};
  sheet.facts.missions.notes = {"set a < b"};
  sheet.facts.missions.flights = {{0, 40, {"mission_<1>.kmz"}}};
  const std::string html = sheet.Html();
  EXPECT_EQ(Texts(html, "//section[@class='warnings']//li").at(0), "mind the <crane> & wires");
  EXPECT_NE(html.find("&lt;b&gt;&amp;&quot;F00"), std::string::npos);
  EXPECT_NE(html.find("Cam &lt;1&gt; &amp; more"), std::string::npos);
  EXPECT_NE(html.find("set a &lt; b"), std::string::npos);
  EXPECT_NE(html.find("mission_&lt;1&gt;.kmz"), std::string::npos);
}

TEST(Checklist, HasARowForEachFlightWithItsFiles) {
  Sheet sheet;
  const test::TemporaryFolder folder;
  sheet.plan.flights[1].home_m = Eigen::Vector3d(100, -40, 0);
  sheet.facts.missions = WriteMissionFiles(sheet.plan, test::Mavic3E(), folder.path());
  const auto rows = Texts(sheet.Html(), "//section[h2='Flights']//tbody/tr");
  ASSERT_EQ(rows.size(), 4u);
  EXPECT_NE(rows[0].find("2 / 4"), std::string::npos) << rows[0];
  EXPECT_NE(rows[0].find("8 to 30 m"), std::string::npos) << rows[0];
  EXPECT_NE(rows[1].find("mission_1.kmz, mission_1.csv, mission_1.plan"), std::string::npos);
  EXPECT_EQ(rows[1].find("mission_2"), std::string::npos);
  EXPECT_NE(rows[2].find("1 / 5"), std::string::npos) << rows[2];
  const auto homes = Texts(sheet.Html(), "//section[h2='Flights']//tbody/tr/td[2]");
  EXPECT_NE(homes.at(0), homes.at(2));
}

// A pixel is 2 mm at 40 m and half a millimetre at 10 m: half of that in 1/2000 s at 0.5 m/s.
TEST(Checklist, TheShutterFollowsThePixel) {
  Sheet sheet;
  sheet.plan.camera.focal_m = 0.02;
  sheet.plan.camera.sensor_width_m = 0.004;
  sheet.plan.camera.width_px = 4000;
  sheet.plan.d_min_m = 10;
  sheet.plan.pace.speed_m_per_s = 5;
  const std::string html = sheet.Html();
  EXPECT_NE(html.find("Shutter 1/2000 s"), std::string::npos);
  EXPECT_NE(html.find("needs 1/20000 s"), std::string::npos);
}

TEST(Checklist, TellsTheHoursOfSun) {
  Sheet sheet;
  sheet.plan.origin.latitude_deg = 50;
  sheet.facts.days = SunDays("2026-12-21");
  const auto rows = Texts(sheet.Html(), "//section[h2='Sun on the facades']//tbody/tr");
  ASSERT_EQ(rows.size(), 4u);  // four directions
  EXPECT_TRUE(rows[0].starts_with("N (0 degrees)")) << rows[0];
  EXPECT_TRUE(rows[0].ends_with("never")) << rows[0];
  EXPECT_TRUE(rows[2].starts_with("S (180 degrees)")) << rows[2];
  EXPECT_NE(rows[2].find("B0001/F00"), std::string::npos) << rows[2];
  EXPECT_NE(rows[2].find(" to 15:"), std::string::npos) << rows[2];
  EXPECT_EQ(Texts(sheet.Html(), "//section[h2='Sun on the facades']//th").size(), 3u);
}

TEST(Checklist, ListsGroundPointsOrSaysThatThereAreNone) {
  Sheet sheet;
  EXPECT_NE(sheet.Html().find("No ground that is free"), std::string::npos);
  sheet.facts.ground_points = {
      {"G1",
       "south-west corner",
       {{-5, -5, 0}, Eigen::Vector3d::UnitZ(), SurfaceKind::kGround, 12, 0.01}}};
  const auto rows = Texts(sheet.Html(), "//section[h2[starts-with(.,'Control')]]//tbody/tr");
  ASSERT_EQ(rows.size(), 1u);
  EXPECT_NE(rows[0].find("G1south-west corner"), std::string::npos) << rows[0];
  EXPECT_NE(rows[0].find("1210 cm"), std::string::npos) << rows[0];  // 12 photos, ten pixels wide
}

TEST(Checklist, OfAnEmptyPlanIsAPage) {
  const std::string html = ChecklistHtml({}, StatsOf({}, 0, 0), {});
  EXPECT_EQ(Texts(html, "/html/body").size(), 1u);
  EXPECT_FALSE(HasNoNumber(html));
}

}  // namespace
}  // namespace stucco::plan
