// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// The rules are those of DJI's WPML documentation for template.kml, waylines.wpml and their common
// elements, and what its readers are known to refuse.
#include "plan/mission/wpml_lint.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <pugixml.hpp>

#include "plan/mission/internal/wpml_rules.h"
#include "plan/mission/internal/zip_archive.h"
#include "plan/mission/wpml.h"

namespace stucco::plan {
namespace {

using internal::FieldRule;
using internal::LintLog;
using internal::Place;

constexpr const char* kTemplate = "wpmz/template.kml";
constexpr const char* kWaylines = "wpmz/waylines.wpml";

const std::vector<FieldRule>& WaylineFolderRules() {
  static const std::vector<FieldRule> rules = {
      {"wpml:templateId", true, FieldRule::kWhole, 0, 65534},
      {"wpml:executeHeightMode",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"WGS84", "relativeToStartPoint", "realTimeFollowSurface"}},
      {"wpml:waylineId", true, FieldRule::kWhole, 0, 65534},
      {"wpml:distance", true, FieldRule::kNumber, 0, 1e7},
      {"wpml:duration", true, FieldRule::kNumber, 0, 1e6},
      {"wpml:autoFlightSpeed", true, FieldRule::kNumber, 0.1, 15},
      {"Placemark", true, FieldRule::kGroup},
  };
  return rules;
}

const std::vector<FieldRule>& TemplateFolderRules() {
  static const std::vector<FieldRule> rules = {
      {"wpml:templateType",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"waypoint", "mapping2d", "mapping3d", "mappingStrip"}},
      {"wpml:templateId", true, FieldRule::kWhole, 0, 65534},
      {"wpml:waylineCoordinateSysParam", true, FieldRule::kGroup},
      {"wpml:autoFlightSpeed", true, FieldRule::kNumber, 0.1, 15},
      {"wpml:globalHeight", false, FieldRule::kNumber, -1500, 9000},
      {"wpml:gimbalPitchMode", false, FieldRule::kOneOf, 0, 0, {"manual", "usePointSetting"}},
      {"wpml:payloadParam", false, FieldRule::kGroup},
      {"Placemark", false, FieldRule::kGroup},
  };
  return rules;
}

const std::vector<FieldRule>& CoordinateRules() {
  static const std::vector<FieldRule> rules = {
      {"wpml:coordinateMode", true, FieldRule::kOneOf, 0, 0, {"WGS84"}},
      {"wpml:heightMode",
       true,
       FieldRule::kOneOf,
       0,
       0,
       {"EGM96", "relativeToStartPoint", "aboveGroundLevel", "realTimeFollowSurface"}},
      {"wpml:positioningType",
       false,
       FieldRule::kOneOf,
       0,
       0,
       {"GPS", "RTKBaseStation", "QianXun", "Custom"}},
  };
  return rules;
}

const std::vector<FieldRule>& PayloadParamRules() {
  static const std::vector<FieldRule> rules = {
      {"wpml:payloadPositionIndex", true, FieldRule::kWhole, 0, 2},
      {"wpml:imageFormat",
       false,
       FieldRule::kListOf,
       0,
       0,
       {"wide", "zoom", "ir", "narrow_band", "visible", "visable"}},  // DJI writes both spellings
  };
  return rules;
}

std::optional<Place> Document(const pugi::xml_document& xml, LintLog& log) {
  const pugi::xml_node kml = xml.child("kml");
  if (!kml) {
    log.Add("kml", "required", "is missing: this is no KML");
    return std::nullopt;
  }
  const std::string_view space = kml.attribute("xmlns:wpml").value();
  if (!space.starts_with("http://www.dji.com/wpmz/") &&
      !space.starts_with("http://www.uav.com/wpmz/")) {
    log.Add("kml", "namespace", fmt::format("xmlns:wpml is \"{}\"", space));
  }
  const pugi::xml_node document = kml.child("Document");
  if (!document) {
    log.Add("kml/Document", "required", "is missing");
    return std::nullopt;
  }
  return Place{document, ""};
}

double DroneOf(const Place& document) {
  const Place drone = document.Child("wpml:missionConfig").Child("wpml:droneInfo");
  return drone.Number("wpml:droneEnumValue").value_or(0);
}

void CheckConfigOf(const Place& document, LintLog& log) {
  const Place config = document.Child("wpml:missionConfig");
  if (config.node) {
    internal::CheckConfig(config, log);
  } else {
    log.Add(config.path, "required", "is missing");
  }
}

void CheckWaylineDocument(const Place& document, LintLog& log) {
  CheckConfigOf(document, log);
  const Place folder = document.Child("Folder");
  if (!folder.node) {
    log.Add(folder.path, "required", "is missing");
    return;
  }
  internal::CheckFields(folder, WaylineFolderRules(), log);
  internal::CheckWaypoints(folder, /*is_template=*/false, DroneOf(document), log);
}

// Coordinates are lon,lat and the take-off point is lat,lon: who mixes them up flies elsewhere.
void CheckTakeOff(const Place& document, const Place& folder, LintLog& log) {
  constexpr double kFar = 1;  // degrees, farther than any drone flies
  const auto home =
      internal::ParsePair(document.Child("wpml:missionConfig").Text("wpml:takeOffRefPoint"));
  int index = 0;
  for (const pugi::xml_node node : folder.node.children("Placemark")) {
    const Place point =
        Place{node, fmt::format("{}/Placemark[{}]", folder.path, index++)}.Child("Point");
    const auto here = internal::ParsePair(point.Text("coordinates"));
    if (!home || !here) continue;
    constexpr double kTurn = 360;  // places on both sides of the date line are neighbours
    if (std::abs(std::remainder(here->first - home->second, kTurn)) > kFar ||
        std::abs(here->second - home->first) > kFar) {
      log.Add(point.Of("coordinates"), "take-off",
              fmt::format("{},{} is longitude,latitude far from takeOffRefPoint, which is "
                          "latitude,longitude {},{}",
                          here->first, here->second, home->first, home->second));
      return;  // one is enough: the others are as wrong
    }
  }
}

void CheckTemplateDocument(const Place& document, LintLog& log) {
  CheckConfigOf(document, log);
  const Place folder = document.Child("Folder");
  if (!folder.node) {  // DJI Fly's own templates have none
    if (DroneOf(document) != kDjiFlyDrone) log.Add(folder.path, "required", "is missing");
    return;
  }
  internal::CheckFields(folder, TemplateFolderRules(), log, internal::Order::kFree);
  const Place system = folder.Child("wpml:waylineCoordinateSysParam");
  if (system.node) internal::CheckFields(system, CoordinateRules(), log);
  const Place payload = folder.Child("wpml:payloadParam");
  if (payload.node) internal::CheckFields(payload, PayloadParamRules(), log);
  CheckTakeOff(document, folder, log);
  if (folder.Text("wpml:templateType") == "waypoint") {
    internal::CheckWaypoints(folder, /*is_template=*/true, DroneOf(document), log);
  }
}

using DocumentCheck = void (*)(const Place&, LintLog&);

std::vector<LintFinding> Lint(const std::string& bytes, const char* name, DocumentCheck check) {
  LintLog log(name);
  pugi::xml_document xml;
  const pugi::xml_parse_result parsed = xml.load_buffer(bytes.data(), bytes.size());
  if (!parsed) {
    log.Add("", "xml", fmt::format("byte {}: {}", parsed.offset, parsed.description()));
  } else if (const auto document = Document(xml, log)) {
    check(*document, log);
  }
  return log.Take();
}

// What Pilot 2 shows must be what the drone flies.
void CompareWaypoints(const Place& shown, const Place& flown, LintLog& log) {
  constexpr double kSameDegrees = 1e-7;  // a centimetre
  pugi::xml_node one = shown.node.child("Placemark");
  pugi::xml_node other = flown.node.child("Placemark");
  for (int i = 0; one || other; ++i) {
    const std::string path = fmt::format("Folder/Placemark[{}]", i);
    if (!one || !other) {
      log.Add(path, "agreement", one ? "is not flown" : "is flown but not in the template");
      return;
    }
    const auto point = internal::ParsePair(Place{one, path}.Child("Point").Text("coordinates"));
    const auto flown_point =
        internal::ParsePair(Place{other, path}.Child("Point").Text("coordinates"));
    if (point && flown_point &&
        std::max(std::abs(point->first - flown_point->first),
                 std::abs(point->second - flown_point->second)) > kSameDegrees) {
      log.Add(path + "/Point/coordinates", "agreement",
              fmt::format("{},{} but flown {},{}", point->first, point->second, flown_point->first,
                          flown_point->second));
    }
    const auto height = Place{one, path}.Number("wpml:height");
    const auto flown_height = Place{other, path}.Number("wpml:executeHeight");
    if (height && flown_height && std::abs(*height - *flown_height) > 0.01) {
      log.Add(path + "/wpml:height", "agreement",
              fmt::format("{} but flown {}", *height, *flown_height));
    }
    one = one.next_sibling("Placemark");
    other = other.next_sibling("Placemark");
  }
}

void CompareConfigs(const Place& shown, const Place& flown, LintLog& log) {
  for (const pugi::xml_node child : flown.node.children()) {
    if (child.first_child().type() != pugi::node_pcdata) continue;
    const std::string_view text = shown.node.child_value(child.name());
    if (text != child.child_value()) {
      log.Add(shown.Of(child.name()), "agreement",
              fmt::format("{} but flown with {}", text, child.child_value()));
    }
  }
}

std::vector<LintFinding> Compare(const std::string& shown, const std::string& flown) {
  LintLog log(kTemplate);
  pugi::xml_document one;
  pugi::xml_document other;
  if (!one.load_string(shown.c_str()) || !other.load_string(flown.c_str())) return {};
  const Place a = {one.child("kml").child("Document"), ""};
  const Place b = {other.child("kml").child("Document"), ""};
  const Place config = a.Child("wpml:missionConfig");
  CompareConfigs(config, b.Child("wpml:missionConfig"), log);
  if (DroneOf(a) != DroneOf(b)) {
    log.Add(config.Of("wpml:droneInfo"), "agreement", "names another drone than waylines.wpml");
  }
  const Place folder = a.Child("Folder");
  const bool comparable = folder.Text("wpml:templateType") == "waypoint" &&
                          folder.Child("wpml:waylineCoordinateSysParam").Text("wpml:heightMode") ==
                              b.Child("Folder").Text("wpml:executeHeightMode");
  if (comparable) CompareWaypoints(folder, b.Child("Folder"), log);
  return log.Take();
}

void Append(std::vector<LintFinding> more, std::vector<LintFinding>& findings) {
  std::ranges::move(more, std::back_inserter(findings));
}

}  // namespace

std::vector<LintFinding> LintWaylines(const std::string& xml) {
  return Lint(xml, kWaylines, CheckWaylineDocument);
}

std::vector<LintFinding> LintTemplate(const std::string& xml) {
  return Lint(xml, kTemplate, CheckTemplateDocument);
}

std::vector<LintFinding> LintKmz(const std::filesystem::path& path) {
  std::vector<LintFinding> findings;
  const std::string name = path.filename().string();
  if (path.extension() != ".kmz") findings.push_back({name, "file-name", "must end in .kmz"});
  std::optional<std::string> shown;
  std::optional<std::string> flown;
  for (internal::ZipEntry& entry : internal::ReadZip(path)) {
    if (entry.name == kTemplate) shown = std::move(entry.bytes);
    if (entry.name == kWaylines) flown = std::move(entry.bytes);
    if (!entry.name.starts_with("wpmz/")) {
      findings.push_back({entry.name, "zip-path", "lies outside the folder wpmz/"});
    }
  }
  if (!flown) findings.push_back({kWaylines, "zip-path", "is missing"});
  if (!shown) findings.push_back({kTemplate, "zip-path", "is missing"});
  if (shown) Append(LintTemplate(*shown), findings);
  if (flown) Append(LintWaylines(*flown), findings);
  if (shown && flown) Append(Compare(*shown, *flown), findings);
  return findings;
}

}  // namespace stucco::plan
