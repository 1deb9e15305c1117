// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "plan/mission/internal/wpml_rules.h"
#include "plan/mission/wpml.h"

namespace stucco::plan::internal {
namespace {

using Rules = std::vector<FieldRule>;

const Rules& ConfigRules() {
  static const Rules rules = {
      {"wpml:flyToWaylineMode", true, FieldRule::kOneOf, 0, 0, {"safely", "pointToPoint"}},
      {"wpml:finishAction",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"goHome", "noAction", "autoLand", "gotoFirstWaypoint"}},
      {"wpml:exitOnRCLost", true, FieldRule::kOneOf, 0, 0, {"goContinue", "executeLostAction"}},
      {"wpml:executeRCLostAction", false, FieldRule::kOneOf, 0, 0, {"goBack", "landing", "hover"}},
      {"wpml:takeOffSecurityHeight", false, FieldRule::kNumber, 1.2, 1500},
      {"wpml:takeOffRefPoint", false, FieldRule::kAny},
      {"wpml:globalTransitionalSpeed", true, FieldRule::kNumber, 0.1, 15},
      {"wpml:globalRTHHeight", false, FieldRule::kNumber, 2, 1500},
      {"wpml:droneInfo", true, FieldRule::kGroup},
      {"wpml:payloadInfo", false, FieldRule::kGroup},
  };
  return rules;
}

const Rules& DroneRules() {
  static const Rules rules = {
      {"wpml:droneEnumValue",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"60", "67", "68", "77", "89", "91", "99", "100", "103"}},
      {"wpml:droneSubEnumValue", false, FieldRule::kWhole, 0, 9},
  };
  return rules;
}

const Rules& PayloadRules() {
  static const Rules rules = {
      {"wpml:payloadEnumValue", true, FieldRule::kWhole, 1, 1e6},
      {"wpml:payloadPositionIndex", true, FieldRule::kWhole, 0, 2},
  };
  return rules;
}

// lat,lon,alt here, while coordinates are lon,lat.
void CheckReferencePoint(const Place& config, LintLog& log) {
  const std::string text = config.Text("wpml:takeOffRefPoint");
  if (text.empty()) return;
  const std::string element = config.Of("wpml:takeOffRefPoint");
  const auto pair = ParsePair(text);
  if (!pair || std::ranges::count(text, ',') != 2) {
    log.Add(element, "coordinates", "must be latitude,longitude,height, not \"" + text + "\"");
  } else if (std::abs(pair->first) > 90 || std::abs(pair->second) > 180) {
    log.Add(element, "coordinates",
            fmt::format("latitude {} or longitude {} out of range; latitude comes first here",
                        pair->first, pair->second));
  }
}

}  // namespace

void CheckConfig(const Place& config, LintLog& log) {
  CheckFields(config, ConfigRules(), log);
  if (config.Text("wpml:exitOnRCLost") == "executeLostAction" &&
      !config.node.child("wpml:executeRCLostAction")) {
    log.Add(config.Of("wpml:executeRCLostAction"), "required",
            "is missing, but exitOnRCLost is executeLostAction");
  }
  CheckReferencePoint(config, log);
  const Place drone = config.Child("wpml:droneInfo");
  if (drone.node) CheckFields(drone, DroneRules(), log);
  const Place payload = config.Child("wpml:payloadInfo");
  if (payload.node) CheckFields(payload, PayloadRules(), log);
  if (drone.Number("wpml:droneEnumValue") == kDjiFlyDrone) return;
  // DJI Fly knows neither; Pilot 2 refuses missions without.
  for (const char* name : {"wpml:takeOffSecurityHeight", "wpml:payloadInfo"}) {
    if (!config.node.child(name)) log.Add(config.Of(name), "required", "is missing");
  }
}

}  // namespace stucco::plan::internal
