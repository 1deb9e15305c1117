// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// Missions for Litchi and QGroundControl, read back and flown action by action.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <set>

#include "plan/mission/litchi.h"
#include "plan/mission/qgroundcontrol.h"
#include "survey/error.h"
#include "tests/plan/mission_fixture.h"

namespace stucco::plan {
namespace {

struct TakenPhoto {
  Eigen::Vector2d position_m;
  double height_m = 0;
  double yaw_deg = 0;
  double pitch_deg = 0;
};

void ExpectView(const Plan& plan, const TakenPhoto& photo, const PlannedView& view,
                double angle_deg) {
  SCOPED_TRACE(view.id);
  EXPECT_LT((photo.position_m - view.position_m.head<2>()).norm(), 0.01);
  EXPECT_NEAR(photo.height_m, view.position_m.z() - plan.home_m.z(), 0.01);
  EXPECT_NEAR(SignedDegrees(photo.yaw_deg - view.yaw_deg), 0, angle_deg);
  EXPECT_NEAR(photo.pitch_deg, view.pitch_deg, angle_deg);
}

constexpr size_t kColumns = 46;
constexpr size_t kFirstAction = 8;

std::vector<TakenPhoto> FlyLitchi(const Plan& plan, const std::string& csv) {
  std::vector<TakenPhoto> photos;
  const auto table = test::Table(csv, ',');
  for (size_t row = 1; row < table.size(); ++row) {
    const std::vector<std::string>& cells = table[row];
    EXPECT_EQ(cells.size(), kColumns);
    const auto number = [&](size_t i) { return std::stod(cells.at(i)); };
    TakenPhoto state = {test::PlanFromLonLat(plan, number(1), number(0)), number(2), number(3),
                        number(7)};
    EXPECT_GE(number(3), 0);
    EXPECT_LT(number(3), 360);
    EXPECT_EQ(cells[4], "0");                  // stops, else actions are passed over
    EXPECT_EQ(cells[6], "2");                  // gimbal interpolates to its angle
    EXPECT_EQ(cells[kFirstAction + 30], "0");  // heights from take-off
    bool waited = false;
    for (size_t i = 0; i < 15; ++i) {
      const int type = std::stoi(cells.at(kFirstAction + 2 * i));
      const double param = number(kFirstAction + 2 * i + 1);
      if (type == 4) state.yaw_deg = param;
      if (type == 5) state.pitch_deg = param;
      if (type == 0) waited = param >= 1000;
      if (type != 1) continue;
      EXPECT_TRUE(waited);
      waited = false;
      photos.push_back(state);
    }
  }
  return photos;
}

TEST(Litchi, TakesEveryPlannedPhoto) {
  const Plan plan = test::MakePlan(1.25);
  size_t first = 0;
  for (const MissionRoute& route : MissionRoutes(plan)) {
    const auto files = LitchiCsv(plan, route, test::Mavic3E());
    ASSERT_EQ(files.size(), 1u);
    const auto photos = FlyLitchi(plan, files[0]);
    ASSERT_EQ(photos.size(), first == 0 ? 4u : 5u);
    // Turns and tilts between the photos of a hover are whole degrees.
    for (size_t i = 0; i < photos.size(); ++i) {
      ExpectView(plan, photos[i], plan.views[first + i], 0.5);
    }
    first += photos.size();
  }
}

TEST(Litchi, HasTheColumnsOfTheApp) {
  const Plan plan = test::MakePlan();
  const auto table = test::Table(LitchiCsv(plan, MissionRoutes(plan)[0], test::Mavic3E())[0], ',');
  ASSERT_EQ(table[0].size(), kColumns);
  EXPECT_EQ(table[0][3], "heading(deg)");
  EXPECT_EQ(table[0][kFirstAction], "actiontype1");
  EXPECT_EQ(table[0][kFirstAction + 29], "actionparam15");
  EXPECT_EQ(table[0][kColumns - 1], "photo_distinterval");
}

TEST(Litchi, SplitsStopsWithManyPhotos) {
  Plan plan = test::MakePlan();
  MissionRoute route = MissionRoutes(plan)[1];
  std::vector<PlannedView>& views = route.stops[1].views;
  const PlannedView last = views.back();
  for (int i = 0; i < 9; ++i) {
    views.push_back(last);
    views.back().yaw_deg = 36 * i;
    views.back().pitch_deg = -10 * i;
  }
  const size_t wanted = views.size();
  const auto files = LitchiCsv(plan, route, test::Mavic3E());
  const auto photos = FlyLitchi(plan, files.at(0));
  ASSERT_EQ(photos.size(), wanted);
  for (size_t i = 0; i < wanted; ++i) {
    EXPECT_NEAR(SignedDegrees(photos[i].yaw_deg - views[i].yaw_deg), 0, 0.5);
    EXPECT_NEAR(photos[i].pitch_deg, views[i].pitch_deg, 0.5);
    EXPECT_NEAR(photos[i].height_m, route.stops[1].height_m, 2);
  }
}

TEST(Litchi, SplitsLongFlightsAndApproachesFromAbove) {
  Plan plan = test::MakePlan();
  MissionRoute route = MissionRoutes(plan)[0];
  const MissionStop stop = route.stops[1];
  for (int i = 0; i < 250; ++i) {
    route.stops.push_back(stop);
    route.stops.back().position_m.x() -= i;
    route.stops.back().geodetic =
        GeodeticFromPlan(plan.origin, route.stops.back().position_m.head<2>());
  }
  const auto files = LitchiCsv(plan, route, test::Mavic3E());
  ASSERT_EQ(files.size(), 3u);
  size_t photos = 0;
  for (const std::string& file : files) {
    const auto table = test::Table(file, ',');
    EXPECT_LE(table.size() - 1, kLitchiWaypoints);
    EXPECT_EQ(table[1][2], "30.00");
    EXPECT_EQ(table.back()[2], "30.00");
    photos += FlyLitchi(plan, file).size();
  }
  EXPECT_EQ(photos, 504u);
}

TEST(Litchi, TellsWhatTheFileCannotHold) {
  const std::vector<std::string> settings =
      LitchiSettings(MissionRoutes(test::MakePlan())[0], test::Mavic3E());
  ASSERT_GE(settings.size(), 5u);
  EXPECT_NE(settings[0].find("Heading Mode"), std::string::npos);
  EXPECT_NE(settings.back().find("30 m"), std::string::npos);
}

std::vector<TakenPhoto> FlyQGroundControl(const Plan& plan, const nlohmann::json& file) {
  std::vector<TakenPhoto> photos;
  TakenPhoto state;
  bool waited = false;
  for (const nlohmann::json& item : file["mission"]["items"]) {
    const nlohmann::json& params = item["params"];
    EXPECT_EQ(params.size(), 7u);
    const int command = item["command"];
    if (command == 16) {
      EXPECT_EQ(item["frame"], 3);
      EXPECT_EQ(item["Altitude"], params[6]);
      state.position_m = test::PlanFromLonLat(plan, params[5], params[4]);
      state.height_m = params[6];
      state.yaw_deg = params[3];
    } else {
      EXPECT_EQ(item["frame"], command == 22 ? 3 : 2);
    }
    if (command == 205) state.pitch_deg = params[0];
    if (command == 93) waited = params[0] >= 1;
    if (command != 2000) continue;
    EXPECT_TRUE(waited);
    EXPECT_EQ(params[2], 1);
    photos.push_back(state);
  }
  return photos;
}

TEST(QGroundControl, TakesEveryPlannedPhoto) {
  const Plan plan = test::MakePlan(1.25);
  size_t first = 0;
  for (const MissionRoute& route : MissionRoutes(plan)) {
    const auto json = nlohmann::json::parse(QGroundControlPlan(plan, route, test::Mavic3E()));
    const auto photos = FlyQGroundControl(plan, json);
    ASSERT_EQ(photos.size(), first == 0 ? 4u : 5u);
    for (size_t i = 0; i < photos.size(); ++i) {
      ExpectView(plan, photos[i], plan.views[first + i], 0.01);
    }
    first += photos.size();
  }
}

TEST(QGroundControl, HasTheFrameOfAPlan) {
  const Plan plan = test::MakePlan();
  const auto json =
      nlohmann::json::parse(QGroundControlPlan(plan, MissionRoutes(plan)[0], test::Mavic3E()));
  EXPECT_EQ(json["fileType"], "Plan");
  EXPECT_EQ(json["version"], 1);
  EXPECT_EQ(json["mission"]["version"], 2);
  EXPECT_EQ(json["rallyPoints"]["version"], 2);
  const auto& items = json["mission"]["items"];
  EXPECT_EQ(items.front()["command"], 22);
  EXPECT_EQ(items.front()["Altitude"], 30);
  EXPECT_EQ(items.back()["command"], 20);
  for (size_t i = 0; i < items.size(); ++i) EXPECT_EQ(items[i]["doJumpId"], i + 1);
  const auto& home = json["mission"]["plannedHomePosition"];
  EXPECT_LT((test::PlanFromLonLat(plan, home[1], home[0]) - plan.home_m.head<2>()).norm(), 0.01);
}

// Fields that the developers' guide of QGroundControl documents ("Plan File Format"), by their
// type.
bool IsPlace(const nlohmann::json& place, size_t numbers) {
  return place.is_array() && place.size() == numbers &&
         std::ranges::all_of(place, [](const auto& number) { return number.is_number(); }) &&
         std::abs(place[0].get<double>()) <= 90 && std::abs(place[1].get<double>()) <= 180;
}

void ExpectOnly(const nlohmann::json& object, const std::set<std::string>& keys) {
  ASSERT_TRUE(object.is_object());
  std::set<std::string> found;
  for (const auto& [key, value] : object.items()) found.insert(key);
  EXPECT_EQ(found, keys);
}

void ExpectSimpleItem(const nlohmann::json& item) {
  std::set<std::string> keys = {"type", "autoContinue", "command", "doJumpId", "frame", "params"};
  const bool has_place = item["frame"] == 3;
  if (has_place) keys.insert({"Altitude", "AltitudeMode", "AMSLAltAboveTerrain"});
  ExpectOnly(item, keys);
  EXPECT_EQ(item["type"], "SimpleItem");
  EXPECT_TRUE(item["autoContinue"].is_boolean());
  EXPECT_TRUE(item["command"].is_number_integer());
  EXPECT_TRUE(item["doJumpId"].is_number_integer());
  ASSERT_EQ(item["params"].size(), 7U);
  for (const auto& param : item["params"]) EXPECT_TRUE(param.is_number() || param.is_null());
  if (!has_place) return;
  EXPECT_TRUE(item["Altitude"].is_number());
  EXPECT_EQ(item["AltitudeMode"], 1);
  EXPECT_TRUE(item["AMSLAltAboveTerrain"].is_null());
}

TEST(QGroundControl, HoldsTheDocumentedFieldsAndNoOthers) {
  const Plan plan = test::MakePlan();
  for (const MissionRoute& route : MissionRoutes(plan)) {
    const auto json = nlohmann::json::parse(QGroundControlPlan(plan, route, test::Mavic3E()));
    ExpectOnly(json,
               {"fileType", "version", "groundStation", "mission", "geoFence", "rallyPoints"});
    const auto& mission = json["mission"];
    ExpectOnly(mission, {"version", "firmwareType", "vehicleType", "cruiseSpeed", "hoverSpeed",
                         "globalPlanAltitudeMode", "plannedHomePosition", "items"});
    for (const char* key : {"firmwareType", "vehicleType", "globalPlanAltitudeMode"}) {
      EXPECT_TRUE(mission[key].is_number_integer()) << key;
    }
    EXPECT_GT(mission["cruiseSpeed"], 0);
    EXPECT_GT(mission["hoverSpeed"], 0);
    EXPECT_TRUE(IsPlace(mission["plannedHomePosition"], 3));
    ASSERT_FALSE(mission["items"].empty());
    for (const auto& item : mission["items"]) ExpectSimpleItem(item);
    ExpectOnly(json["geoFence"], {"version", "circles", "polygons"});
    EXPECT_EQ(json["geoFence"]["version"], 2);
    EXPECT_TRUE(json["geoFence"]["circles"].is_array());
    for (const auto& fence : json["geoFence"]["polygons"]) {
      ExpectOnly(fence, {"version", "inclusion", "polygon"});
      EXPECT_EQ(fence["version"], 1);
      EXPECT_GE(fence["polygon"].size(), 3U);
      for (const auto& corner : fence["polygon"]) EXPECT_TRUE(IsPlace(corner, 2));
    }
    ExpectOnly(json["rallyPoints"], {"version", "points"});
  }
}

// A fence has no holes: one that the flight takes place in is a fence to stay within.
TEST(QGroundControl, StaysWithinTheHoleThatItFliesIn) {
  Plan plan = test::MakePlan();
  const Eigen::Vector2d home = MissionRoutes(plan)[0].home_m.head<2>();
  const auto square = [](const Eigen::Vector2d& middle, double half) {
    return Ring{middle + Eigen::Vector2d(-half, -half), middle + Eigen::Vector2d(half, -half),
                middle + Eigen::Vector2d(half, half), middle + Eigen::Vector2d(-half, half)};
  };
  const auto hole = [&](const Eigen::Vector2d& middle, double half) {
    Ring ring = square(middle, half);
    std::ranges::reverse(ring);
    return ring;
  };
  const Eigen::Vector2d far(900, 900);
  plan.no_fly_m = {square(home, 300), hole(home, 200), square(far, 50), hole(far, 20)};
  const auto json =
      nlohmann::json::parse(QGroundControlPlan(plan, MissionRoutes(plan)[0], test::Mavic3E()));
  const auto& fences = json["geoFence"]["polygons"];
  ASSERT_EQ(fences.size(), 2U);
  const auto half_width = [&](const nlohmann::json& fence, const Eigen::Vector2d& middle) {
    const auto& corner = fence["polygon"][0];
    return (test::PlanFromLonLat(plan, corner[1], corner[0]) - middle).cwiseAbs().maxCoeff();
  };
  EXPECT_EQ(fences[0]["inclusion"], true);
  EXPECT_NEAR(half_width(fences[0], home), 200, 0.1);
  EXPECT_EQ(fences[1]["inclusion"], false);
  EXPECT_NEAR(half_width(fences[1], far), 50, 0.1);
}

TEST(QGroundControl, FencesNoFlyAreasClockwise) {
  const Plan plan = test::MakePlan();
  const auto json =
      nlohmann::json::parse(QGroundControlPlan(plan, MissionRoutes(plan)[0], test::Mavic3E()));
  ASSERT_EQ(json["geoFence"]["polygons"].size(), 1u);
  const auto& fence = json["geoFence"]["polygons"][0];
  EXPECT_EQ(fence["inclusion"], false);
  ASSERT_EQ(fence["polygon"].size(), 4u);
  double twice_area = 0;
  std::vector<Eigen::Vector2d> corners;
  for (const auto& corner : fence["polygon"]) {
    corners.push_back(test::PlanFromLonLat(plan, corner[1], corner[0]));
  }
  for (size_t i = 0; i < 4; ++i) {
    const Eigen::Vector2d& p = corners[i];
    const Eigen::Vector2d& q = corners[(i + 1) % 4];
    twice_area += p.x() * q.y() - p.y() * q.x();
  }
  EXPECT_NEAR(twice_area, -2 * 30 * 40, 1);
}

}  // namespace
}  // namespace stucco::plan
