// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/plan/mission_fixture.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <sstream>

#include "survey/coordinate_system.h"

namespace stucco::test {
namespace {

constexpr double kHigh = 30;

void AddView(Plan& plan, int hover, const Eigen::Vector3d& position, double yaw_deg,
             double pitch_deg, const std::string& facade) {
  PlannedView view;
  view.order = static_cast<int>(plan.views.size());
  view.id = fmt::format("h{:03}v{}", hover, view.order);
  view.position_m = position;
  view.yaw_deg = yaw_deg;
  view.pitch_deg = pitch_deg;
  view.kind = facade.empty() ? (pitch_deg < -80 ? ViewKind::kNadir : ViewKind::kOblique)
                             : (pitch_deg < 0 ? ViewKind::kDippingFoot : ViewKind::kDipping);
  view.hover = hover;
  view.flight = static_cast<int>(plan.flights.size()) - 1;
  if (!facade.empty()) {
    for (PlannedFacade& wall : plan.facades) {
      if (wall.id != facade) continue;
      view.targets = {{facade, {0, (wall.b_m - wall.a_m).norm()}, wall.z_m}};
      wall.views.push_back(view.id);
    }
  }
  plan.views.push_back(view);
}

void AddBuilding(Plan& plan, const std::string& id, const std::vector<Eigen::Vector2d>& ring) {
  plan.footprints.push_back({id, {ring}, {0, 12}, kHigh});
  for (size_t i = 0; i < ring.size(); ++i) {
    PlannedFacade facade;
    facade.id = fmt::format("{}/F{:02}", id, i);
    facade.a_m = ring[i];
    facade.b_m = ring[(i + 1) % ring.size()];
    facade.z_m = {0, 12};
    facade.predicted = {0.9, 0.2 * static_cast<double>(i), 0.7, 1};
    if (i == 2) facade.unobservable_m = {{1, 4.5}};
    plan.facades.push_back(facade);
  }
}

void AddPass(Plan& plan, const Eigen::Vector3d& position) {
  plan.flights.back().waypoints.push_back({position, -1});
}

void AddStop(Plan& plan, const Eigen::Vector3d& position, int hover) {
  plan.flights.back().waypoints.push_back({position, hover});
}

void FlyOne(Plan& plan) {
  plan.flights.emplace_back();
  const Eigen::Vector3d above_home(plan.home_m.x(), plan.home_m.y(), kHigh);
  AddPass(plan, plan.home_m);
  AddPass(plan, above_home);
  AddStop(plan, {20, -15, 8}, 0);
  AddView(plan, 0, {20, -15, 8}, 0, 0, "B0001/F00");
  AddView(plan, 0, {20, -15, 8}, 0, -35.25, "B0001/F00");
  AddPass(plan, {52, -12, 8});
  AddStop(plan, {55, 12, 8}, 1);
  AddView(plan, 1, {55, 12, 8}, 270.125, 0, "B0001/F01");
  AddView(plan, 1, {55, 12, 8}, 90, 0, "B0002/F03");
  AddPass(plan, above_home);
  AddPass(plan, plan.home_m);
  plan.flights.back().length_m = 231.5;
  plan.flights.back().time_min = 3.25;
  plan.flights.back().battery_percent = 12.5;
  plan.flights.back().parts = {1, 0.75, 1, 0.5};
}

void FlyTwo(Plan& plan) {
  plan.flights.emplace_back();
  AddPass(plan, {plan.home_m.x(), plan.home_m.y(), kHigh});
  AddStop(plan, {40, 10, kHigh}, 2);
  AddView(plan, 2, {40, 10, kHigh}, 0, -90, "");
  for (const double yaw : {0.0, 90.0, 180.0, -90.0}) {
    AddView(plan, 2, {40, 10, kHigh}, yaw, -45, "");
  }
  AddPass(plan, {plan.home_m.x(), plan.home_m.y(), kHigh});
  plan.flights.back().length_m = 140;
  plan.flights.back().time_min = 1.5;
  plan.flights.back().battery_percent = 6;
  plan.flights.back().parts = {0.5, 0.25, 0.5, 0.25};
}

}  // namespace

Plan MakePlan() {
  return MakePlan(0);
}

Plan MakePlan(double home_z_m) {
  Plan plan;
  plan.method = "cocapture";
  plan.origin = {52.0116, 4.3571, 0};
  plan.crs = fmt::format("+proj=tmerc +lat_0={} +lon_0={} +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m",
                         plan.origin.latitude_deg, plan.origin.longitude_deg);
  plan.camera = {"mavic-3e", "DJI Mavic 3E", 0.01229, 0.0173, 0.013, 5280, 3956};
  plan.d_min_m = 10;
  plan.d_max_m = 60;
  plan.safe_altitude_m = kHigh;
  plan.min_altitude_m = 5;
  plan.home_m = {-30, -40, home_z_m};
  AddBuilding(plan, "B0001", {{0, 0}, {40, 0}, {40, 25}, {0, 25}});
  AddBuilding(plan, "B<2>&", {{70, 0}, {95, 0}, {95, 25}, {70, 25}});
  plan.footprints[0].rings_m.push_back({{15, 8}, {15, 17}, {25, 17}, {25, 8}});
  for (PlannedFacade& facade : plan.facades) {
    if (facade.id.starts_with("B<2>&")) facade.id.replace(0, 5, "B0002");
  }
  plan.no_fly_m = {{{120, 0}, {150, 0}, {150, 40}, {120, 40}}};
  FlyOne(plan);
  FlyTwo(plan);
  return plan;
}

Eigen::Vector2d PlanFromLonLat(const Plan& plan, double longitude_deg, double latitude_deg) {
  const std::vector<Geodetic> place = {{latitude_deg, longitude_deg}};
  return CrsFromGeodetic(plan.crs, place, "plan").front();
}

plan::MissionOptions Mavic3E() {
  plan::MissionOptions options;
  options.dji = {77, 0, 66};
  return options;
}

std::vector<std::vector<std::string>> Table(const std::string& text, char separator) {
  std::vector<std::vector<std::string>> table;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::vector<std::string>& fields = table.emplace_back();
    std::istringstream cells(line);
    for (std::string cell; std::getline(cells, cell, separator);) fields.push_back(cell);
  }
  return table;
}

std::string Replaced(std::string text, const std::string& from, const std::string& to) {
  const size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << "\"" << from << "\" does not occur";
  if (at != std::string::npos) text.replace(at, from.size(), to);
  return text;
}

}  // namespace stucco::test
