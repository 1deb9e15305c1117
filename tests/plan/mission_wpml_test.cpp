// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <gtest/gtest.h>
#include <stdlib.h>
#include <time.h>

#include <pugixml.hpp>

#include "plan/mission/internal/zip_archive.h"
#include "plan/mission/mission.h"
#include "plan/mission/wpml.h"
#include "plan/mission/wpml_lint.h"
#include "survey/error.h"
#include "survey/files.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

using test::TemporaryFolder;

double Number(pugi::xml_node node, const char* path) {
  return node.first_element_by_path(path).text().as_double(std::nan(""));
}
std::string Text(pugi::xml_node node, const char* path) {
  return node.first_element_by_path(path).child_value();
}

// A photo as the drone would take it: the state that the actions before it leave.
struct Taken {
  std::string id;
  Eigen::Vector2d position_m;
  double height_m = 0;
  double yaw_deg = 0;
  double pitch_deg = 0;
};

// Plays a wayline file action by action.
std::vector<Taken> Fly(const Plan& plan, const std::string& waylines) {
  pugi::xml_document xml;
  EXPECT_TRUE(xml.load_string(waylines.c_str()));
  std::vector<Taken> photos;
  Taken state;
  state.pitch_deg = std::nan("");
  double hovered_s = 0;
  for (const pugi::xml_node placemark :
       xml.child("kml").child("Document").child("Folder").children("Placemark")) {
    double lon = 0;
    double lat = 0;
    EXPECT_EQ(sscanf(Text(placemark, "Point/coordinates").c_str(), "%lf,%lf", &lon, &lat), 2);
    state.position_m = test::PlanFromLonLat(plan, lon, lat);
    state.height_m = Number(placemark, "wpml:executeHeight");
    state.yaw_deg = Number(placemark, "wpml:waypointHeadingParam/wpml:waypointHeadingAngle");
    for (const pugi::xml_node action :
         placemark.child("wpml:actionGroup").children("wpml:action")) {
      const std::string function = Text(action, "wpml:actionActuatorFunc");
      const pugi::xml_node param = action.child("wpml:actionActuatorFuncParam");
      if (function == "rotateYaw") state.yaw_deg = Number(param, "wpml:aircraftHeading");
      if (function == "gimbalRotate")
        state.pitch_deg = Number(param, "wpml:gimbalPitchRotateAngle");
      if (function == "hover") hovered_s = Number(param, "wpml:hoverTime");
      if (function != "takePhoto") continue;
      EXPECT_GE(hovered_s, 1);
      hovered_s = 0;
      state.id = Text(param, "wpml:fileSuffix");
      photos.push_back(state);
    }
  }
  return photos;
}

void ExpectViews(const Plan& plan, const std::vector<Taken>& photos, size_t first) {
  for (size_t i = 0; i < photos.size(); ++i) {
    const PlannedView& view = plan.views.at(first + i);
    SCOPED_TRACE(view.id);
    EXPECT_EQ(photos[i].id, view.id);
    EXPECT_LT((photos[i].position_m - view.position_m.head<2>()).norm(), 0.01);
    EXPECT_NEAR(photos[i].height_m, view.position_m.z() - plan.home_m.z(), 0.01);
    EXPECT_NEAR(SignedDegrees(photos[i].yaw_deg - view.yaw_deg), 0, 0.01);
    EXPECT_NEAR(photos[i].pitch_deg, view.pitch_deg, 0.01);
  }
}

TEST(Wpml, TakesEveryPlannedPhoto) {
  const Plan plan = test::MakePlan(1.25);
  const std::vector<MissionRoute> routes = MissionRoutes(plan);
  const auto first = Fly(plan, WpmlWaylines(routes[0], test::Mavic3E()));
  const auto second = Fly(plan, WpmlWaylines(routes[1], test::Mavic3E()));
  ASSERT_EQ(first.size(), 4u);
  ASSERT_EQ(second.size(), 5u);
  ExpectViews(plan, first, 0);
  ExpectViews(plan, second, 4);
}

TEST(Wpml, PassesTheLinter) {
  const Plan plan = test::MakePlan();
  const TemporaryFolder folder;
  for (const DroneEnums& dji : {DroneEnums{77, 0, 66}, DroneEnums{89, 0, 42}, DroneEnums{67, 0, 52},
                                DroneEnums{kDjiFlyDrone, 0, 0}}) {
    MissionOptions options;
    options.dji = dji;
    for (const MissionRoute& route : MissionRoutes(plan)) {
      WriteWpmlKmz(plan, route, options, folder / "m.kmz");
      for (const LintFinding& finding : LintKmz(folder / "m.kmz")) {
        ADD_FAILURE() << finding.element << ": " << finding.text << " (" << finding.rule << ")";
      }
    }
  }
}

TEST(Wpml, SaysHowHighAndHowToReturn) {
  const Plan plan = test::MakePlan();
  const MissionRoute route = MissionRoutes(plan)[0];
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(WpmlWaylines(route, test::Mavic3E()).c_str()));
  const pugi::xml_node document = xml.child("kml").child("Document");
  EXPECT_EQ(Number(document, "wpml:missionConfig/wpml:takeOffSecurityHeight"), 30);
  EXPECT_EQ(Number(document, "wpml:missionConfig/wpml:globalRTHHeight"), 30);
  EXPECT_EQ(Text(document, "wpml:missionConfig/wpml:finishAction"), "goHome");
  EXPECT_EQ(Number(document, "wpml:missionConfig/wpml:droneInfo/wpml:droneEnumValue"), 77);
  EXPECT_EQ(Number(document, "wpml:missionConfig/wpml:payloadInfo/wpml:payloadEnumValue"), 66);
  EXPECT_EQ(Text(document, "Folder/wpml:executeHeightMode"), "relativeToStartPoint");
  EXPECT_EQ(Number(document, "Folder/wpml:distance"), 231.5);
  EXPECT_EQ(Number(document, "Folder/wpml:duration"), 195);
}

TEST(Wpml, StopsAtCornersWithoutActions) {
  const MissionRoute route = MissionRoutes(test::MakePlan())[0];
  pugi::xml_document xml;
  ASSERT_TRUE(xml.load_string(WpmlWaylines(route, test::Mavic3E()).c_str()));
  for (const pugi::xml_node placemark :
       xml.child("kml").child("Document").child("Folder").children("Placemark")) {
    EXPECT_EQ(Text(placemark, "wpml:waypointTurnParam/wpml:waypointTurnMode"),
              "toPointAndStopWithDiscontinuityCurvature");
    const int index = static_cast<int>(Number(placemark, "wpml:index"));
    EXPECT_EQ(!placemark.child("wpml:actionGroup"), route.stops[index].views.empty());
  }
}

TEST(Wpml, DjiFlyGetsItsOwnDialect) {
  MissionOptions options;
  options.dji = {kDjiFlyDrone, 0, 0};
  const std::string text = WpmlWaylines(MissionRoutes(test::MakePlan())[0], options);
  EXPECT_NE(text.find("<wpml:gimbalHeadingYawBase>aircraft<"), std::string::npos);
  EXPECT_NE(text.find("waypointHeadingAngleEnable>1<"), std::string::npos);
  EXPECT_EQ(text.find("payloadInfo"), std::string::npos);
}

TEST(Wpml, SameBytesInAnyTimeZone) {
  const Plan plan = test::MakePlan();
  const MissionRoute route = MissionRoutes(plan)[0];
  const TemporaryFolder folder;
  WriteWpmlKmz(plan, route, test::Mavic3E(), folder / "one.kmz");
  setenv("TZ", "Asia/Tokyo", 1);
  tzset();
  WriteWpmlKmz(plan, route, test::Mavic3E(), folder / "two.kmz");
  unsetenv("TZ");
  tzset();
  const std::string bytes = ReadFile(folder / "one.kmz");
  EXPECT_EQ(bytes, ReadFile(folder / "two.kmz"));
  EXPECT_GT(bytes.size(), 1000u);
}

TEST(Wpml, RefusesADroneWithoutNumber) {
  const Plan plan = test::MakePlan();
  const TemporaryFolder folder;
  EXPECT_THROW(WriteWpmlKmz(plan, MissionRoutes(plan)[0], {}, folder / "m.kmz"), Error);
  EXPECT_FALSE(std::filesystem::exists(folder / "m.kmz"));
}

TEST(ZipArchive, ReadsWhatItWrote) {
  const TemporaryFolder folder;
  internal::WriteZip(folder / "a.zip", {{"x/y.txt", "hello"}, {"empty", ""}});
  const auto entries = internal::ReadZip(folder / "a.zip");
  ASSERT_EQ(entries.size(), 2u);
  EXPECT_EQ(entries[0].name, "x/y.txt");
  EXPECT_EQ(entries[0].bytes, "hello");
  EXPECT_EQ(entries[1].bytes, "");
}

TEST(ZipArchive, RefusesDamage) {
  const TemporaryFolder folder;
  EXPECT_THROW(internal::ReadZip(folder / "none.zip"), Error);
  WriteFile(folder / "bad.zip", "PK\x03\x04 not a zip");
  EXPECT_THROW(internal::ReadZip(folder / "bad.zip"), Error);
  EXPECT_THROW(internal::WriteZip(folder / "no/such/folder.zip", {{"a", "b"}}), Error);
  internal::WriteZip(folder / "a.zip", {{"a", std::string(5000, 'x')}});
  std::string bytes = ReadFile(folder / "a.zip");
  bytes[40] ^= 0x55;  // in the compressed data
  WriteFile(folder / "a.zip", bytes);
  EXPECT_THROW(internal::ReadZip(folder / "a.zip"), Error);
}

TEST(ZipArchive, RefusesToFillTheMemory) {
  const TemporaryFolder folder;
  const std::string megabytes(90u << 20, '\0');  // packs to a few kilobytes
  internal::WriteZip(folder / "a.zip", {{"a", megabytes}, {"b", megabytes}, {"c", megabytes}});
  EXPECT_LT(std::filesystem::file_size(folder / "a.zip"), 1u << 20);
  EXPECT_THROW(internal::ReadZip(folder / "a.zip"), Error);
}

TEST(MissionFiles, WritesAllThatTheDroneAllows) {
  const Plan plan = test::MakePlan();
  const TemporaryFolder folder;
  const MissionFiles files = WriteMissionFiles(plan, test::Mavic3E(), folder.path());
  const std::vector<std::string> expected = {"mission_1.kmz", "mission_2.kmz",  "mission_1.csv",
                                             "mission_2.csv", "mission_1.plan", "mission_2.plan",
                                             "mission.kml",   "plan.geojson"};
  EXPECT_EQ(files.names, expected);
  for (const std::string& name : files.names) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
  ASSERT_EQ(files.flights.size(), 2u);
  EXPECT_EQ(files.flights[1].flight, 1u);
  EXPECT_EQ(files.flights[1].names,
            (std::vector<std::string>{"mission_2.kmz", "mission_2.csv", "mission_2.plan"}));
  EXPECT_GE(files.flights[1].return_height_m, plan.safe_altitude_m);
  ASSERT_FALSE(files.notes.empty());
  EXPECT_NE(files.notes.back().find("no-fly"), std::string::npos);
}

TEST(MissionFiles, SaysWhyThereIsNoKmz) {
  Plan plan = test::MakePlan();
  plan.flights.pop_back();
  std::erase_if(plan.views, [](const PlannedView& view) { return view.flight > 0; });
  const TemporaryFolder folder;
  const MissionFiles files = WriteMissionFiles(plan, {}, folder.path());
  const std::vector<std::string> expected = {"mission.csv", "mission.plan", "mission.kml",
                                             "plan.geojson"};
  EXPECT_EQ(files.names, expected);
  EXPECT_NE(files.notes.front().find("no mission.kmz"), std::string::npos);
}

TEST(MissionFiles, NamesThePartsOfLongFlights) {
  Plan plan = test::MakePlan();
  auto& waypoints = plan.flights[0].waypoints;
  for (int i = 0; i < 100; ++i) waypoints.insert(waypoints.begin() + 2, {{-25.0, 1.0 * i, 30}, -1});
  const TemporaryFolder folder;
  WriteMissionFiles(plan, test::Mavic3E(), folder.path());
  for (const char* name : {"mission_1_1.csv", "mission_1_2.csv", "mission_2_1.csv"}) {
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  }
}

TEST(MissionFiles, SaysWhenDjiFlyHoldsLess) {
  Plan plan = test::MakePlan();
  auto& waypoints = plan.flights[0].waypoints;
  for (int i = 0; i < 200; ++i) waypoints.insert(waypoints.begin() + 2, {{-25.0, 1.0 * i, 30}, -1});
  const TemporaryFolder folder;
  MissionOptions options;
  options.dji.drone = kDjiFlyDrone;
  const std::string note = WriteMissionFiles(plan, options, folder.path()).notes.front();
  EXPECT_NE(note.find("mission_1.kmz has 205 waypoints"), std::string::npos) << note;
}

TEST(MissionFiles, RefusesAnEmptyPlan) {
  const TemporaryFolder folder;
  EXPECT_THROW(WriteMissionFiles({}, test::Mavic3E(), folder.path()), Error);
}

}  // namespace
}  // namespace stucco::plan
