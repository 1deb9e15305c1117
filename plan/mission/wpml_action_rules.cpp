// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

#include "plan/mission/internal/wpml_rules.h"

namespace stucco::plan::internal {
namespace {

using Rules = std::vector<FieldRule>;

const Rules& GroupRules() {
  static const Rules rules = {
      {"wpml:actionGroupId", true, FieldRule::kWhole, 0, 65534},
      {"wpml:actionGroupStartIndex", true, FieldRule::kWhole, 0, 65535},
      {"wpml:actionGroupEndIndex", true, FieldRule::kWhole, 0, 65535},
      {"wpml:actionGroupMode", true, FieldRule::kOneOf, 0, 0, {"sequence", "parallel"}},
      {"wpml:actionTrigger", true, FieldRule::kGroup},
      {"wpml:action", true, FieldRule::kGroup},
  };
  return rules;
}

const Rules& TriggerRules() {
  static const Rules rules = {
      {"wpml:actionTriggerType",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"reachPoint", "betweenAdjacentPoints", "multipleTiming", "multipleDistance"}},
      {"wpml:actionTriggerParam", false, FieldRule::kNumber, 0.01, 1e6},
  };
  return rules;
}

const Rules& ActionRules() {
  static const Rules rules = {
      {"wpml:actionId", true, FieldRule::kWhole, 0, 65535},
      {"wpml:actionActuatorFunc",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"takePhoto", "startRecord", "stopRecord", "focus", "zoom", "customDirName", "gimbalRotate",
        "gimbalEvenlyRotate", "rotateYaw", "hover", "orientedShoot", "panoShot",
        "recordPointCloud"}},
      {"wpml:actionActuatorFuncParam", true, FieldRule::kGroup},
  };
  return rules;
}

const FieldRule kPayload = {"wpml:payloadPositionIndex", true, FieldRule::kWhole, 0, 2};
// The widest range of any gimbal: that of the M300's.
constexpr double kGimbalDown = -120;
constexpr double kGimbalUp = 45;

const Rules& GimbalRules() {
  static const Rules rules = {
      {"wpml:gimbalHeadingYawBase", false, FieldRule::kOneOf, 0, 0, {"north", "aircraft"}},
      {"wpml:gimbalRotateMode", true, FieldRule::kOneOf, 0, 0, {"absoluteAngle", "relativeAngle"}},
      {"wpml:gimbalPitchRotateEnable", true, FieldRule::kFlag},
      {"wpml:gimbalPitchRotateAngle", false, FieldRule::kNumber, kGimbalDown, kGimbalUp},
      {"wpml:gimbalRollRotateEnable", true, FieldRule::kFlag},
      {"wpml:gimbalRollRotateAngle", false, FieldRule::kNumber, -180, 180},
      {"wpml:gimbalYawRotateEnable", true, FieldRule::kFlag},
      {"wpml:gimbalYawRotateAngle", false, FieldRule::kNumber, -180, 180},
      {"wpml:gimbalRotateTimeEnable", false, FieldRule::kFlag},
      {"wpml:gimbalRotateTime", false, FieldRule::kNumber, 0, 3600},
      kPayload,
  };
  return rules;
}

const std::map<std::string, Rules>& ParamRules() {
  static const std::map<std::string, Rules> rules = {
      {"takePhoto", {{"wpml:fileSuffix", false, FieldRule::kAny}, kPayload}},
      {"startRecord", {kPayload}},
      {"stopRecord", {kPayload}},
      {"focus", {kPayload}},
      {"zoom", {{"wpml:focalLength", true, FieldRule::kNumber, 0.1, 10000}, kPayload}},
      {"customDirName", {{"wpml:directoryName", true, FieldRule::kAny}}},
      {"gimbalRotate", GimbalRules()},
      {"gimbalEvenlyRotate",
       {{"wpml:gimbalPitchRotateAngle", true, FieldRule::kNumber, kGimbalDown, kGimbalUp},
        kPayload}},
      {"rotateYaw",
       {{"wpml:aircraftHeading", true, FieldRule::kNumber, -180, 180},
        {"wpml:aircraftPathMode",
         false,
         FieldRule::kOneOf,
         0,
         0,
         {"clockwise", "counterClockwise"}}}},
      {"hover", {{"wpml:hoverTime", true, FieldRule::kNumber}}},
      {"orientedShoot",
       {{"wpml:gimbalPitchRotateAngle", true, FieldRule::kNumber, kGimbalDown, kGimbalUp},
        {"wpml:gimbalYawRotateAngle", true, FieldRule::kNumber, -180, 180},
        {"wpml:aircraftHeading", true, FieldRule::kNumber, -180, 180}}},
  };
  return rules;
}

bool IsFileName(const std::string& text) {
  return std::ranges::all_of(text, [](unsigned char c) {
    return c < 128 && (std::isalnum(c) != 0 || c == '_' || c == '-');
  });
}

void CheckSuffix(const Place& param, ActionCensus& census, LintLog& log) {
  const std::string suffix = param.Text("wpml:fileSuffix");
  if (suffix.empty()) return;
  const std::string element = param.Of("wpml:fileSuffix");
  if (!IsFileName(suffix)) {
    log.Add(element, "file-suffix",
            fmt::format("\"{}\" has characters beyond letters, digits, _ and -", suffix));
  }
  if (!census.suffixes.insert(suffix).second) {
    log.Add(element, "file-suffix-unique", fmt::format("\"{}\" names two photos", suffix));
  }
}

// An axis that is switched on needs an angle.
void CheckGimbalAxes(const Place& param, LintLog& log) {
  for (const char* axis : {"Pitch", "Roll", "Yaw"}) {
    const std::string enable = fmt::format("wpml:gimbal{}RotateEnable", axis);
    const std::string angle = fmt::format("wpml:gimbal{}RotateAngle", axis);
    if (param.Text(enable.c_str()) == "1" && !param.node.child(angle.c_str())) {
      log.Add(param.Of(angle.c_str()), "required", "is missing, but " + enable + " is 1");
    }
  }
}

void CheckAction(const Place& action, ActionCensus& census, LintLog& log) {
  CheckFields(action, ActionRules(), log);
  const std::string function = action.Text("wpml:actionActuatorFunc");
  const Place param = action.Child("wpml:actionActuatorFuncParam");
  const auto rules = ParamRules().find(function);
  if (!param.node || rules == ParamRules().end()) return;
  CheckFields(param, rules->second, log);
  if (function == "takePhoto") CheckSuffix(param, census, log);
  if (function == "gimbalRotate") CheckGimbalAxes(param, log);
  const auto hover = param.Number("wpml:hoverTime");
  if (function == "hover" && hover && !(*hover > 0)) {
    log.Add(param.Of("wpml:hoverTime"), "hover-time", "must be more than 0 seconds");
  }
}

void CheckTrigger(const Place& group, const Place& trigger, LintLog& log) {
  CheckFields(trigger, TriggerRules(), log);
  const std::string type = trigger.Text("wpml:actionTriggerType");
  const bool is_repeated = type == "multipleTiming" || type == "multipleDistance";
  if (is_repeated && !trigger.node.child("wpml:actionTriggerParam")) {
    log.Add(trigger.Of("wpml:actionTriggerParam"), "required", "is missing for " + type);
  }
  if (type != "betweenAdjacentPoints") return;
  for (const pugi::xml_node action : group.node.children("wpml:action")) {
    const Place place = {action, group.Of("wpml:action")};
    if (place.Text("wpml:actionActuatorFunc") == "gimbalEvenlyRotate") continue;
    log.Add(place.path, "trigger", "only gimbalEvenlyRotate goes with betweenAdjacentPoints");
  }
}

void CheckGroup(const Place& group, int waypoints, ActionCensus& census, LintLog& log) {
  CheckFields(group, GroupRules(), log);
  CheckTrigger(group, group.Child("wpml:actionTrigger"), log);
  if (const auto id = group.Number("wpml:actionGroupId")) {
    if (!census.group_ids.insert(*id).second) {
      log.Add(group.Of("wpml:actionGroupId"), "action-group-id",
              fmt::format("{} is used by another group", *id));
    }
  }
  const auto start = group.Number("wpml:actionGroupStartIndex");
  const auto end = group.Number("wpml:actionGroupEndIndex");
  if (start && end && !(*start <= *end && *end < waypoints)) {
    log.Add(group.Of("wpml:actionGroupEndIndex"), "action-group-range",
            fmt::format("waypoints {} to {} of {}", *start, *end, waypoints));
  }
}

}  // namespace

void CheckActions(const Place& placemark, int waypoints, ActionCensus& census, LintLog& log) {
  int group_index = 0;
  for (const pugi::xml_node node : placemark.node.children("wpml:actionGroup")) {
    const Place group = {node,
                         fmt::format("{}/wpml:actionGroup[{}]", placemark.path, group_index++)};
    CheckGroup(group, waypoints, census, log);
    int index = 0;
    std::vector<std::string> ids;
    for (const pugi::xml_node action_node : node.children("wpml:action")) {
      const Place action = {action_node, fmt::format("{}/wpml:action[{}]", group.path, index++)};
      CheckAction(action, census, log);
      const std::string id = action.Text("wpml:actionId");
      if (std::ranges::find(ids, id) != ids.end()) {
        log.Add(action.Of("wpml:actionId"), "action-id", id + " is used twice in its group");
      }
      ids.push_back(id);
    }
  }
}

}  // namespace stucco::plan::internal
