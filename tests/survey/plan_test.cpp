// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>

#include "survey/files.h"
#include "survey/plan_io.h"
#include "tests/survey/support.h"

namespace stucco {
namespace {

using test::ErrorOf;
using test::ExpectBadInput;
using test::TemporaryFolder;

PlannedView MakeView(const std::string& id, int order) {
  PlannedView view;
  view.id = id;
  view.position_m = {6.0001, -15.12345, 20.0 - order};
  view.yaw_deg = 0.00049 + 90 * order;
  view.pitch_deg = -20.00051;
  view.kind = order == 0 ? ViewKind::kDipping : ViewKind::kDippingFoot;
  view.hover = order;
  view.order = order;
  view.targets = {{"B0001/F00", {0, 6.5}, {0, 9}}};
  return view;
}

// Two photos of one wall of a building with a courtyard.
Plan MakePlan() {
  Plan plan;
  plan.method = "cocapture";
  plan.crs = "+proj=tmerc +lat_0=52.01 +lon_0=4.36";
  plan.origin = {52.0123456789, 4.3612345678, 12.3456};
  plan.camera = {"mavic-3e", "DJI Mavic 3E", 0.01229, 0.0173, 0.013, 5280, 3956};
  plan.d_min_m = 10;
  plan.d_max_m = 57.123456;
  plan.safe_altitude_m = 25;
  plan.min_altitude_m = 5;
  plan.home_m = {-20, -20, 0};
  plan.footprints = {{"B0001",
                      {{{0, 0}, {30, 0}, {30, 30}, {0, 30}}, {{10, 10}, {10, 20}, {20, 20}}},
                      {-1, 9},
                      25}};
  plan.no_fly_m = {{{50, 50}, {60, 50}, {60, 60}}};
  PlannedFacade facade;
  facade.id = "B0001/F00";
  facade.b_m = {30, 0};
  facade.z_m = {0, 9};
  facade.top_known = true;
  facade.views = {"v0", "v1"};
  facade.predicted = {0.98765, 0.5, 1, 0.25};
  facade.unobservable_m = {{2, 3}, {29, 30}};
  plan.facades = {facade};
  plan.views = {MakeView("v0", 0), MakeView("v1", 1)};
  plan.views[1].partners = {{"v0", 0.23456}};
  plan.views[1].is_loose = true;
  plan.flights = {{{{plan.home_m, -1},
                    {plan.views[0].position_m, 0},
                    {plan.views[1].position_m, 1},
                    {plan.home_m, -1}},
                   70.5,
                   2.25,
                   8.125,
                   2.5,
                   {0.5, 1, 0.5, 0.25},
                   Eigen::Vector3d(-20, -21, 1.5)}};
  plan.pace.wind_m_per_s = 7;
  return plan;
}

Plan WrittenAndRead(const Plan& plan) {
  const TemporaryFolder folder;
  WritePlan(plan, folder / "plan.json");
  return ReadPlan(folder / "plan.json");
}

void ExpectPosition(const Eigen::VectorXd& read, const Eigen::VectorXd& written) {
  EXPECT_LE((read - written).cwiseAbs().maxCoeff(), 0.0005 + 1e-12);
}

TEST(PlanFile, ObstaclesAreMarked) {
  Plan plan = MakePlan();
  plan.footprints.push_back({"O0001", {{{40, 0}, {44, 0}, {44, 4}}}, {0, 12}, 22, true});
  const TemporaryFolder folder;
  WritePlan(plan, folder / "plan.json");
  const Plan read = ReadPlan(folder / "plan.json");
  EXPECT_FALSE(read.footprints[0].is_obstacle);
  EXPECT_TRUE(read.footprints[1].is_obstacle);
  // Buildings are written as ever.
  const std::string text = ReadFile(folder / "plan.json");
  EXPECT_EQ(text.find("obstacle"), text.rfind("obstacle"));
}

TEST(PlanFile, ReadsBackAsWritten) {
  const Plan plan = MakePlan();
  const Plan read = WrittenAndRead(plan);
  EXPECT_EQ(read.method, "cocapture");
  EXPECT_EQ(read.crs, plan.crs);
  EXPECT_EQ(read.origin.latitude_deg, plan.origin.latitude_deg);
  EXPECT_EQ(read.origin.longitude_deg, plan.origin.longitude_deg);
  EXPECT_EQ(read.origin.height_m, 12.346);
  EXPECT_EQ(read.camera.label, "DJI Mavic 3E");
  EXPECT_EQ(read.camera.focal_m, 0.01229);
  EXPECT_EQ(read.camera.height_px, 3956);
  EXPECT_EQ(read.d_max_m, 57.123);
  EXPECT_EQ(read.min_altitude_m, 5);
  EXPECT_TRUE(read.views[0].partners.empty());
  ASSERT_EQ(read.views[1].partners.size(), 1u);
  EXPECT_EQ(read.views[1].partners[0].view, "v0");
  EXPECT_EQ(read.views[1].partners[0].strength, 0.2346);
  EXPECT_FALSE(read.views[0].is_loose);
  EXPECT_TRUE(read.views[1].is_loose);
  ExpectPosition(read.home_m, plan.home_m);
  ASSERT_EQ(read.footprints.size(), 1u);
  EXPECT_EQ(read.footprints[0].rings_m, plan.footprints[0].rings_m);
  EXPECT_EQ(read.footprints[0].z_m, (Interval{-1, 9}));
  EXPECT_EQ(read.footprints[0].blocked_to_m, 25);
  EXPECT_EQ(read.no_fly_m, plan.no_fly_m);
  ASSERT_EQ(read.facades.size(), 1u);
  EXPECT_EQ(read.facades[0].views, plan.facades[0].views);
  EXPECT_EQ(read.facades[0].predicted.q_s, 0.9877);
  EXPECT_EQ(read.facades[0].unobservable_m, plan.facades[0].unobservable_m);
  EXPECT_TRUE(read.facades[0].top_known);
}

TEST(PlanFile, ReadsBackViewsAndFlights) {
  const Plan plan = MakePlan();
  const Plan read = WrittenAndRead(plan);
  ASSERT_EQ(read.views.size(), 2u);
  for (size_t i = 0; i < 2; ++i) {
    EXPECT_EQ(read.views[i].id, plan.views[i].id);
    ExpectPosition(read.views[i].position_m, plan.views[i].position_m);
    EXPECT_NEAR(read.views[i].yaw_deg, plan.views[i].yaw_deg, 5.01e-4);
    EXPECT_EQ(read.views[i].pitch_deg, -20.001);
    EXPECT_EQ(read.views[i].kind, plan.views[i].kind);
    EXPECT_EQ(read.views[i].hover, plan.views[i].hover);
    ASSERT_EQ(read.views[i].targets.size(), 1u);
    EXPECT_EQ(read.views[i].targets[0].along_m, (Interval{0, 6.5}));
    EXPECT_EQ(read.views[i].targets[0].z_m, (Interval{0, 9}));
  }
  ASSERT_EQ(read.flights.size(), 1u);
  EXPECT_EQ(read.flights[0].battery_percent, 8.125);
  EXPECT_EQ(read.flights[0].reserve_percent, 2.5);
  EXPECT_EQ(read.flights[0].parts.legs_min, 1);
  EXPECT_EQ(read.flights[0].home_m, plan.flights[0].home_m);
  EXPECT_EQ(read.HomeOf(0), Eigen::Vector3d(-20, -21, 1.5));
  EXPECT_EQ(read.HomeOf(1), plan.home_m);
  EXPECT_EQ(read.pace.wind_m_per_s, 7);
  ASSERT_EQ(read.flights[0].waypoints.size(), 4u);
  EXPECT_EQ(read.flights[0].waypoints[0].hover, -1);
  EXPECT_EQ(read.flights[0].waypoints[2].hover, 1);
  ExpectPosition(read.flights[0].waypoints[1].position_m, plan.views[0].position_m);
}

// Files of before flights had homes of their own and said how they are flown.
TEST(PlanFile, ReadsFlightsWithoutHomeAndPace) {
  const TemporaryFolder folder;
  WritePlan(MakePlan(), folder / "plan.json");
  auto json = nlohmann::json::parse(ReadFile(folder / "plan.json"));
  json.erase("pace");
  for (const char* name : {"home_m", "reserve_percent", "parts"}) json["flights"][0].erase(name);
  WriteFile(folder / "plan.json", json.dump());
  const Plan plan = ReadPlan(folder / "plan.json");
  EXPECT_FALSE(plan.flights[0].home_m);
  EXPECT_EQ(plan.HomeOf(0), plan.home_m);
  EXPECT_EQ(plan.Homes(), std::vector<Eigen::Vector3d>{plan.home_m});
  EXPECT_EQ(plan.pace.speed_m_per_s, 5);
}

TEST(PlanFile, IsStableAndShort) {
  const TemporaryFolder folder;
  WritePlan(MakePlan(), folder / "one.json");
  WritePlan(ReadPlan(folder / "one.json"), folder / "two.json");
  const std::string text = ReadFile(folder / "one.json");
  EXPECT_EQ(text, ReadFile(folder / "two.json"));
  EXPECT_LT(std::count(text.begin(), text.end(), '\n'), 40);
  EXPECT_EQ(text.find("-0.0"), std::string::npos);
}

TEST(PlanFile, TakesViewsByOrder) {
  Plan plan = MakePlan();
  std::swap(plan.views[0], plan.views[1]);
  EXPECT_EQ(WrittenAndRead(plan).views[0].id, "v0");
}

TEST(PlanFile, KindsHaveNames) {
  for (const ViewKind kind : {ViewKind::kDipping, ViewKind::kDippingFoot, ViewKind::kNadir,
                              ViewKind::kOblique, ViewKind::kSurface, ViewKind::kLink}) {
    EXPECT_EQ(ViewKindFromName(Name(kind)), kind);
  }
  EXPECT_EQ(ViewKindFromName("Dipping"), std::nullopt);
}

// The example that docs/formats.md gives to authors of other planners.
TEST(PlanFile, ReadsTheDocumentedExample) {
  const std::string docs = ReadFile(std::filesystem::path(STUCCO_ROOT) / "docs" / "formats.md");
  const size_t begin = docs.find("```json\n") + 8;
  ASSERT_NE(begin, std::string::npos + 8);
  const TemporaryFolder folder;
  WriteFile(folder / "plan.json", docs.substr(begin, docs.find("```\n", begin) - begin));
  const Plan plan = ReadPlan(folder / "plan.json");
  ASSERT_EQ(plan.views.size(), 1u);
  EXPECT_EQ(plan.views[0].kind, ViewKind::kDipping);
  ASSERT_EQ(plan.views[0].targets.size(), 1u);
  EXPECT_EQ(plan.views[0].targets[0].facade, "B0001/F00");
  EXPECT_EQ(plan.views[0].targets[0].along_m, (Interval{0, 12}));
  EXPECT_TRUE(plan.flights.empty());
}

struct Fault {
  const char* name;
  std::string complaint;
  std::function<void(Plan&)> damage;
};

TEST(PlanFile, RefusesWhatDoesNotFitTogether) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Fault> faults = {
      {"latitude", "latitude_deg", [](Plan& p) { p.origin.latitude_deg = 91; }},
      {"longitude", "longitude_deg", [](Plan& p) { p.origin.longitude_deg = -181; }},
      {"d_min", "d_min_m", [](Plan& p) { p.d_min_m = -1; }},
      {"home", "home_m", [=](Plan& p) { p.home_m.x() = nan; }},
      {"flight's home", "home_m", [=](Plan& p) { p.flights[0].home_m->x() = nan; }},
      {"speed", "pace.speed_m_per_s", [](Plan& p) { p.pace.speed_m_per_s = 0; }},
      {"hold", "pace.hold_s", [](Plan& p) { p.pace.hold_s = -1; }},
      {"ring", "fewer than 3", [](Plan& p) { p.footprints[0].rings_m[1].resize(2); }},
      {"corner", "not finite", [=](Plan& p) { p.no_fly_m[0][1].y() = nan; }},
      {"building", "empty \"building\"", [](Plan& p) { p.footprints[0].building.clear(); }},
      {"no ring", "no rings", [](Plan& p) { p.footprints[0].rings_m.clear(); }},
      {"footprint z", "backwards",
       [](Plan& p) {
         p.footprints[0].z_m = {3, 2};
       }},
      {"facade id", "empty id", [](Plan& p) { p.facades[0].id.clear(); }},
      {"two facades", "occurs twice", [](Plan& p) { p.facades.push_back(p.facades[0]); }},
      {"length", "no length", [](Plan& p) { p.facades[0].b_m = p.facades[0].a_m; }},
      {"facade z", "backwards",
       [](Plan& p) {
         p.facades[0].z_m = {3, 2};
       }},
      {"unobservable", "goes beyond", [](Plan& p) { p.facades[0].unobservable_m[1].to_m = 31; }},
      {"view id", "letters", [](Plan& p) { p.views[0].id = "v/0"; }},
      {"empty view id", "letters", [](Plan& p) { p.views[0].id = ""; }},
      {"two views", "occurs twice", [](Plan& p) { p.views[1].id = "v0"; }},
      {"position", "not finite", [=](Plan& p) { p.views[1].position_m.z() = nan; }},
      {"yaw", "yaw_deg", [=](Plan& p) { p.views[1].yaw_deg = nan; }},
      {"pitch", "pitch_deg", [](Plan& p) { p.views[1].pitch_deg = -90.5; }},
      {"order", "same \"order\"", [](Plan& p) { p.views[1].order = 0; }},
      {"hover", "negative \"hover\"", [](Plan& p) { p.views[1].hover = -1; }},
      {"flight", "negative \"flight\"", [](Plan& p) { p.views[1].flight = -1; }},
      {"apart", "m away", [](Plan& p) { p.views[1].hover = 0; }},
      {"facade", "does not exist", [](Plan& p) { p.views[1].targets[0].facade = "B9/F0"; }},
      {"beyond", "beyond the 30", [](Plan& p) { p.views[1].targets[0].along_m.to_m = 30.1; }},
      {"target z", "backwards",
       [](Plan& p) {
         p.views[1].targets[0].z_m = {2, 1};
       }},
      {"partner", "which does not exist",
       [](Plan& p) {
         p.views[0].partners = {{"v9", 1}};
       }},
      {"view", "which does not exist", [](Plan& p) { p.facades[0].views[0] = "v7"; }},
      {"untold", "do not name it", [](Plan& p) { p.facades[0].views.pop_back(); }},
      {"told", "do not name the facade", [](Plan& p) { p.views[1].targets.clear(); }},
      {"twice", "twice", [](Plan& p) { p.facades[0].views.emplace_back("v0"); }},
      {"third flight", "but there are 1", [](Plan& p) { p.views[1].flight = 2; }},
      {"no stop", "no flight stops",
       [](Plan& p) { p.flights[0].waypoints.erase(p.flights[0].waypoints.begin() + 2); }},
      {"unknown stop", "no view", [](Plan& p) { p.flights[0].waypoints[0].hover = 9; }},
      {"second stop", "again", [](Plan& p) { p.flights[0].waypoints[0].hover = 1; }},
  };
  const TemporaryFolder folder;
  for (const Fault& fault : faults) {
    SCOPED_TRACE(fault.name);
    Plan plan = MakePlan();
    fault.damage(plan);
    ExpectBadInput([&] { WritePlan(plan, folder / "plan.json"); }, fault.complaint);
    ExpectBadInput([&] { WritePlan(plan, folder / "plan.json"); }, "plan.json");
  }
  EXPECT_FALSE(std::filesystem::exists(folder / "plan.json"));
}

TEST(PlanFile, NamesTheFieldThatIsWrong) {
  const TemporaryFolder folder;
  WritePlan(MakePlan(), folder / "plan.json");
  const std::string good = ReadFile(folder / "plan.json");
  const auto with = [&](const std::string& old_text, const std::string& new_text) {
    std::string text = good;
    const size_t at = text.find(old_text);
    EXPECT_NE(at, std::string::npos) << old_text;
    WriteFile(folder / "bad.json", text.replace(at, old_text.size(), new_text));
    return [&] { ReadPlan(folder / "bad.json"); };
  };
  ExpectBadInput(with("\"version\": 1", "\"version\": 2"), "version");
  ExpectBadInput(with("\"kind\":\"dipping\"", "\"kind\":\"sideways\""), "views[0].kind");
  ExpectBadInput(with("\"pitch_deg\":-20.001", "\"pitch_deg\":\"down\""), "views[0].pitch_deg");
  ExpectBadInput(with("\"a_m\":[0.0,0.0]", "\"a_m\":[0.0,0.0,0.0]"), "facades[0].a_m");
  ExpectBadInput(with("\"yaw_deg\":0.0,", ""), "\"views[0].yaw_deg\" is missing");
  ExpectBadInput(with("\"z_m\":[0.0,9.0]", "\"z_m\":[0.0]"), "z_m");
  ExpectBadInput(with("\"d_min_m\": 10.0", "\"d_min_m\": 1e999"), "bad.json");
}

// Damaged files are refused or read, but never crash.
TEST(PlanFile, SurvivesTruncation) {
  const TemporaryFolder folder;
  WritePlan(MakePlan(), folder / "plan.json");
  const std::string good = ReadFile(folder / "plan.json");
  for (size_t size = 0; size < good.size(); size += 37) {
    WriteFile(folder / "cut.json", good.substr(0, size));
    EXPECT_FALSE(test::Accepts([&] { ReadPlan(folder / "cut.json"); }));
  }
}

}  // namespace
}  // namespace stucco
