// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "plan/mission/internal/wpml_rules.h"
#include "plan/mission/wpml.h"

namespace stucco::plan::internal {
namespace {

using Rules = std::vector<FieldRule>;

constexpr int kFewestWaypoints = 2;
constexpr int kMostWaypoints = 65535;
constexpr double kLowest = -1500;  // below take-off, where the ground falls away
constexpr double kHighest = 9000;  // above the ellipsoid

const std::vector<std::string_view> kTurnModes = {
    "coordinateTurn", "toPointAndStopWithDiscontinuityCurvature",
    "toPointAndStopWithContinuityCurvature", "toPointAndPassWithContinuityCurvature"};

const Rules& WaypointRules() {
  static const Rules rules = {
      {"Point", true, FieldRule::kGroup},
      {"wpml:index", true, FieldRule::kWhole, 0, kMostWaypoints - 1},
      {"wpml:executeHeight", true, FieldRule::kNumber, kLowest, kHighest},
      {"wpml:waypointSpeed", true, FieldRule::kNumber, 0.1, 15},
      {"wpml:waypointHeadingParam", true, FieldRule::kGroup},
      {"wpml:waypointTurnParam", true, FieldRule::kGroup},
      {"wpml:useStraightLine", false, FieldRule::kFlag},
      {"wpml:actionGroup", false, FieldRule::kGroup},
  };
  return rules;
}

const Rules& TemplateWaypointRules() {
  static const Rules rules = {
      {"Point", true, FieldRule::kGroup},
      {"wpml:index", true, FieldRule::kWhole, 0, kMostWaypoints - 1},
      {"wpml:useGlobalHeight", false, FieldRule::kFlag},
      {"wpml:ellipsoidHeight", false, FieldRule::kNumber, kLowest, kHighest},
      {"wpml:height", false, FieldRule::kNumber, kLowest, kHighest},
      {"wpml:useGlobalSpeed", false, FieldRule::kFlag},
      {"wpml:waypointSpeed", false, FieldRule::kNumber, 0.1, 15},
      {"wpml:useGlobalHeadingParam", false, FieldRule::kFlag},
      {"wpml:waypointHeadingParam", false, FieldRule::kGroup},
      {"wpml:useGlobalTurnParam", false, FieldRule::kFlag},
      {"wpml:waypointTurnParam", false, FieldRule::kGroup},
      {"wpml:useStraightLine", false, FieldRule::kFlag},
      {"wpml:gimbalPitchAngle", false, FieldRule::kNumber, -120, 45},
      {"wpml:actionGroup", false, FieldRule::kGroup},
  };
  return rules;
}

const Rules& HeadingRules() {
  static const Rules rules = {
      {"wpml:waypointHeadingMode",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"followWayline", "manually", "fixed", "smoothTransition", "towardPOI"}},
      {"wpml:waypointHeadingAngle", false, FieldRule::kNumber, -180, 180},
      {"wpml:waypointPoiPoint", false, FieldRule::kAny},
      {"wpml:waypointHeadingAngleEnable", false, FieldRule::kFlag},
      {"wpml:waypointHeadingPathMode",
       false,
       FieldRule::kOneOf,
       0,
       0,
       {"clockwise", "counterClockwise", "followBadArc"}},
  };
  return rules;
}

const Rules& TurnRules() {
  static const Rules rules = {
      {"wpml:waypointTurnMode", true, FieldRule::kOneOf, 0, 0, kTurnModes},
      {"wpml:waypointTurnDampingDist", false, FieldRule::kNumber, 0, 10000},
  };
  return rules;
}

struct LonLat {
  double lon_deg = 0;
  double lat_deg = 0;
};

std::optional<LonLat> CheckPoint(const Place& placemark, LintLog& log) {
  const Place point = placemark.Child("Point");
  if (!point.node) return std::nullopt;
  const std::string text = point.Text("coordinates");
  const std::string element = point.Of("coordinates");
  const auto pair = ParsePair(text);
  if (!pair) {
    log.Add(element, "coordinates", fmt::format("\"{}\" is not longitude,latitude", text));
    return std::nullopt;
  }
  const auto [lon, lat] = *pair;
  if (std::abs(lon) > 180 || std::abs(lat) > 90) {
    log.Add(
        element, "coordinates",
        fmt::format("longitude {} or latitude {} out of range; longitude comes first", lon, lat));
    return std::nullopt;
  }
  return LonLat{lon, lat};
}

double DistanceMetres(const LonLat& one, const LonLat& other) {
  constexpr double kMetresPerDegree = 111320;
  const double cosine = std::cos(one.lat_deg * std::numbers::pi / 180);
  return kMetresPerDegree *
         std::hypot((one.lon_deg - other.lon_deg) * cosine, one.lat_deg - other.lat_deg);
}

void CheckHeading(const Place& heading, LintLog& log) {
  if (!heading.node) return;
  CheckFields(heading, HeadingRules(), log);
  const std::string mode = heading.Text("wpml:waypointHeadingMode");
  if (mode == "smoothTransition" && !heading.node.child("wpml:waypointHeadingAngle")) {
    log.Add(heading.Of("wpml:waypointHeadingAngle"), "required", "is missing for smoothTransition");
  }
  if (mode == "towardPOI" && !heading.node.child("wpml:waypointPoiPoint")) {
    log.Add(heading.Of("wpml:waypointPoiPoint"), "required", "is missing for towardPOI");
  }
}

// How far before a waypoint the drone leaves its leg.
double CheckTurn(const Place& placemark, LintLog& log) {
  const Place turn = placemark.Child("wpml:waypointTurnParam");
  if (!turn.node) return 0;
  CheckFields(turn, TurnRules(), log);
  const std::string mode = turn.Text("wpml:waypointTurnMode");
  const bool cuts = mode == "coordinateTurn" || (mode == "toPointAndPassWithContinuityCurvature" &&
                                                 placemark.Text("wpml:useStraightLine") == "1");
  if (cuts && !turn.node.child("wpml:waypointTurnDampingDist")) {
    log.Add(turn.Of("wpml:waypointTurnDampingDist"), "required", "is missing for " + mode);
  }
  return cuts ? turn.Number("wpml:waypointTurnDampingDist").value_or(0) : 0;
}

// What is known of a waypoint when the next one is looked at.
struct Before {
  std::optional<LonLat> point;
  std::optional<double> height_m;
  double damping_m = 0;
};

void CheckLeg(const Place& placemark, const Before& from, const Before& to, LintLog& log) {
  if (!from.point || !to.point || !from.height_m || !to.height_m) return;
  const double leg =
      std::hypot(DistanceMetres(*from.point, *to.point), *from.height_m - *to.height_m);
  const double damping = from.damping_m + to.damping_m;
  if (damping > 0 && !(damping < leg)) {
    log.Add(placemark.Of("wpml:waypointTurnParam/wpml:waypointTurnDampingDist"), "damping",
            fmt::format("{} m of damping do not fit the leg of {:.2f} m before it", damping, leg));
  }
  if (!(leg > 0)) log.Add(placemark.Of("Point"), "leg", "lies where the waypoint before lies");
}

void CheckTemplateWaypoint(const Place& placemark, LintLog& log) {
  const auto wants = [&](const char* flag, const char* name) {
    if (placemark.Text(flag) == "0" && !placemark.node.child(name)) {
      log.Add(placemark.Of(name), "required", fmt::format("is missing, but {} is 0", flag));
    }
  };
  wants("wpml:useGlobalHeight", "wpml:ellipsoidHeight");
  wants("wpml:useGlobalHeight", "wpml:height");
  wants("wpml:useGlobalSpeed", "wpml:waypointSpeed");
  wants("wpml:useGlobalHeadingParam", "wpml:waypointHeadingParam");
  wants("wpml:useGlobalTurnParam", "wpml:waypointTurnParam");
}

}  // namespace

void CheckWaypoints(const Place& folder, bool is_template, double drone, LintLog& log) {
  std::vector<pugi::xml_node> nodes;
  for (const pugi::xml_node node : folder.node.children("Placemark")) nodes.push_back(node);
  const int count = static_cast<int>(nodes.size());
  if (count < kFewestWaypoints || count > kMostWaypoints) {
    log.Add(
        folder.Of("Placemark"), "waypoint-count",
        fmt::format("{} waypoints, {} to {} are allowed", count, kFewestWaypoints, kMostWaypoints));
  }
  Rules rules = is_template ? TemplateWaypointRules() : WaypointRules();
  if (drone == kDjiFlyDrone) {  // DJI Fly's own files leave the turn to it
    for (FieldRule& rule : rules) {
      rule.required &= std::string_view(rule.name) != "wpml:waypointTurnParam";
    }
  }
  ActionCensus census;
  Before before;
  for (int i = 0; i < count; ++i) {
    const Place placemark = {nodes[i], fmt::format("{}/Placemark[{}]", folder.path, i)};
    CheckFields(placemark, rules, log, is_template ? Order::kFree : Order::kFixed);
    if (const auto index = placemark.Number("wpml:index"); index && *index != i) {
      log.Add(placemark.Of("wpml:index"), "index", fmt::format("is {}, must be {}", *index, i));
    }
    CheckHeading(placemark.Child("wpml:waypointHeadingParam"), log);
    if (is_template) CheckTemplateWaypoint(placemark, log);
    const Before here = {CheckPoint(placemark, log),
                         placemark.Number(is_template ? "wpml:height" : "wpml:executeHeight"),
                         CheckTurn(placemark, log)};
    if (i > 0) CheckLeg(placemark, before, here, log);
    before = here;
    CheckActions(placemark, count, census, log);
  }
}

}  // namespace stucco::plan::internal
