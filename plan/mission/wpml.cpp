// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
// DJI's WPML 1.0.2: the oldest version that all drones with waypoints read.
#include "plan/mission/wpml.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <pugixml.hpp>
#include <string_view>

#include "plan/mission/internal/zip_archive.h"
#include "survey/error.h"

namespace stucco::plan {
namespace {

// What DJI's controllers accept as height of safe take-off.
constexpr double kLowestTakeOff = 1.2;
constexpr double kHighestTakeOff = 1500;

void Put(pugi::xml_node parent, const char* name, std::string_view text) {
  parent.append_child(name).text().set(std::string(text).c_str());
}
void Put(pugi::xml_node parent, const char* name, int64_t number) {
  Put(parent, name, fmt::format("{}", number));
}
void PutDecimal(pugi::xml_node parent, const char* name, double number, int digits) {
  Put(parent, name, fmt::format("{:.{}f}", number + 0.0, digits));
}
void PutAngle(pugi::xml_node parent, const char* name, double degrees) {
  PutDecimal(parent, name, degrees, 2);
}
void PutHeight(pugi::xml_node parent, const char* name, double metres) {
  PutDecimal(parent, name, metres, 2);
}

bool IsDjiFly(const MissionOptions& options) {
  return options.dji.drone == kDjiFlyDrone;
}

// Cameras with several lenses: the mapping photo is the wide one.
bool HasLenses(const DroneEnums& dji) {
  return dji.drone == 67 || dji.drone == 91;
}

pugi::xml_node AddDocument(pugi::xml_document& xml) {
  pugi::xml_node declaration = xml.append_child(pugi::node_declaration);
  declaration.append_attribute("version") = "1.0";
  declaration.append_attribute("encoding") = "UTF-8";
  pugi::xml_node kml = xml.append_child("kml");
  kml.append_attribute("xmlns") = "http://www.opengis.net/kml/2.2";
  kml.append_attribute("xmlns:wpml") = "http://www.dji.com/wpmz/1.0.2";
  return kml.append_child("Document");
}

std::string Text(const pugi::xml_document& xml) {
  struct Writer : pugi::xml_writer {
    std::string text;
    void write(const void* data, size_t size) override {
      text.append(static_cast<const char*>(data), size);
    }
  } writer;
  xml.save(writer, " ");
  return writer.text;
}

void AddConfig(pugi::xml_node document, const Plan* plan, const MissionRoute& route,
               const MissionOptions& options) {
  pugi::xml_node config = document.append_child("wpml:missionConfig");
  Put(config, "wpml:flyToWaylineMode", "safely");
  Put(config, "wpml:finishAction", "goHome");
  Put(config, "wpml:exitOnRCLost", "executeLostAction");
  Put(config, "wpml:executeRCLostAction", "goBack");
  PutHeight(config, "wpml:takeOffSecurityHeight",
            std::clamp(route.take_off_height_m, kLowestTakeOff, kHighestTakeOff));
  if (plan != nullptr) {
    const Geodetic home = GeodeticFromPlan(plan->origin, route.home_m.head<2>());
    Put(config, "wpml:takeOffRefPoint",
        fmt::format("{:.8f},{:.8f},{:.2f}", home.latitude_deg, home.longitude_deg,
                    plan->origin.height_m + route.home_m.z()));
  }
  PutDecimal(config, "wpml:globalTransitionalSpeed", options.pace.transfer_speed_m_per_s, 1);
  PutHeight(config, "wpml:globalRTHHeight", route.return_height_m);
  pugi::xml_node drone = config.append_child("wpml:droneInfo");
  Put(drone, "wpml:droneEnumValue", options.dji.drone);
  Put(drone, "wpml:droneSubEnumValue", options.dji.sub);
  if (options.dji.payload == 0) return;
  pugi::xml_node payload = config.append_child("wpml:payloadInfo");
  Put(payload, "wpml:payloadEnumValue", options.dji.payload);
  Put(payload, "wpml:payloadPositionIndex", 0);
}

pugi::xml_node AddAction(pugi::xml_node group, int& id, const char* function) {
  pugi::xml_node action = group.append_child("wpml:action");
  Put(action, "wpml:actionId", id++);
  Put(action, "wpml:actionActuatorFunc", function);
  return action.append_child("wpml:actionActuatorFuncParam");
}

void AddTurn(pugi::xml_node group, int& id, double from_deg, double to_deg) {
  pugi::xml_node param = AddAction(group, id, "rotateYaw");
  PutAngle(param, "wpml:aircraftHeading", SignedDegrees(to_deg));
  Put(param, "wpml:aircraftPathMode",
      SignedDegrees(to_deg - from_deg) < 0 ? "counterClockwise" : "clockwise");
}

void AddTilt(pugi::xml_node group, int& id, double pitch_deg, const MissionOptions& options) {
  pugi::xml_node param = AddAction(group, id, "gimbalRotate");
  Put(param, "wpml:gimbalHeadingYawBase", IsDjiFly(options) ? "aircraft" : "north");
  Put(param, "wpml:gimbalRotateMode", "absoluteAngle");
  Put(param, "wpml:gimbalPitchRotateEnable", 1);
  PutAngle(param, "wpml:gimbalPitchRotateAngle", pitch_deg);
  for (const char* axis : {"Roll", "Yaw"}) {
    Put(param, fmt::format("wpml:gimbal{}RotateEnable", axis).c_str(), 0);
    Put(param, fmt::format("wpml:gimbal{}RotateAngle", axis).c_str(), 0);
  }
  Put(param, "wpml:gimbalRotateTimeEnable", 0);
  Put(param, "wpml:gimbalRotateTime", 0);
  Put(param, "wpml:payloadPositionIndex", 0);
}

void AddPhoto(pugi::xml_node group, int& id, const std::string& view,
              const MissionOptions& options) {
  PutDecimal(AddAction(group, id, "hover"), "wpml:hoverTime", options.pace.hold_s, 1);
  pugi::xml_node param = AddAction(group, id, "takePhoto");
  Put(param, "wpml:fileSuffix", view);
  Put(param, "wpml:payloadPositionIndex", 0);
  if (!IsDjiFly(options)) Put(param, "wpml:useGlobalPayloadLensIndex", 0);
  if (HasLenses(options.dji)) Put(param, "wpml:payloadLensIndex", "wide");
}

// All photos of a stop, one after the other.
void AddActions(pugi::xml_node placemark, const MissionStop& stop, size_t index, int group_id,
                const MissionOptions& options) {
  pugi::xml_node group = placemark.append_child("wpml:actionGroup");
  Put(group, "wpml:actionGroupId", group_id);
  Put(group, "wpml:actionGroupStartIndex", static_cast<int64_t>(index));
  Put(group, "wpml:actionGroupEndIndex", static_cast<int64_t>(index));
  Put(group, "wpml:actionGroupMode", "sequence");
  Put(group.append_child("wpml:actionTrigger"), "wpml:actionTriggerType", "reachPoint");
  int action = 0;
  const PlannedView* before = nullptr;
  for (const PlannedView& view : stop.views) {
    const double yaw = before == nullptr ? stop.yaw_deg : before->yaw_deg;
    // The first turn repeats the heading on arrival, in case the leg was too short for it.
    if (before == nullptr || std::abs(SignedDegrees(view.yaw_deg - yaw)) > kSmallTurn_deg) {
      AddTurn(group, action, yaw, view.yaw_deg);
    }
    if (before == nullptr || std::abs(view.pitch_deg - before->pitch_deg) > kSmallTurn_deg) {
      AddTilt(group, action, view.pitch_deg, options);
    }
    AddPhoto(group, action, view.id, options);
    before = &view;
  }
}

void AddHeading(pugi::xml_node parent, const char* name, double yaw_deg,
                const MissionOptions& options) {
  pugi::xml_node heading = parent.append_child(name);
  Put(heading, "wpml:waypointHeadingMode", "smoothTransition");
  PutAngle(heading, "wpml:waypointHeadingAngle", yaw_deg);
  Put(heading, "wpml:waypointPoiPoint", "0.000000,0.000000,0.000000");
  if (IsDjiFly(options)) Put(heading, "wpml:waypointHeadingAngleEnable", 1);
  Put(heading, "wpml:waypointHeadingPathMode", "followBadArc");  // the shorter way round
}

// It stops at every point, also where it takes no photo: those points are corners of the space
// that is free to fly in, and a rounded corner leaves that space.
void AddTurnMode(pugi::xml_node parent) {
  pugi::xml_node turn = parent.append_child("wpml:waypointTurnParam");
  Put(turn, "wpml:waypointTurnMode", "toPointAndStopWithDiscontinuityCurvature");
  Put(turn, "wpml:waypointTurnDampingDist", 0);
}

pugi::xml_node AddPlacemark(pugi::xml_node folder, const MissionStop& stop, size_t index) {
  pugi::xml_node placemark = folder.append_child("Placemark");
  Put(placemark.append_child("Point"), "coordinates",
      fmt::format("{:.8f},{:.8f}", stop.geodetic.longitude_deg, stop.geodetic.latitude_deg));
  Put(placemark, "wpml:index", static_cast<int64_t>(index));
  return placemark;
}

void AddTemplateFolder(pugi::xml_node document, const MissionRoute& route,
                       const MissionOptions& options) {
  pugi::xml_node folder = document.append_child("Folder");
  Put(folder, "wpml:templateType", "waypoint");
  Put(folder, "wpml:templateId", 0);
  pugi::xml_node system = folder.append_child("wpml:waylineCoordinateSysParam");
  Put(system, "wpml:coordinateMode", "WGS84");
  Put(system, "wpml:heightMode", "relativeToStartPoint");
  Put(system, "wpml:positioningType", "GPS");
  PutDecimal(folder, "wpml:autoFlightSpeed", options.pace.speed_m_per_s, 1);
  PutHeight(folder, "wpml:globalHeight", route.return_height_m);
  Put(folder, "wpml:gimbalPitchMode", "usePointSetting");
  AddHeading(folder, "wpml:globalWaypointHeadingParam", 0, options);
  Put(folder, "wpml:globalWaypointTurnMode", "toPointAndStopWithDiscontinuityCurvature");
  Put(folder, "wpml:globalUseStraightLine", 1);
  pugi::xml_node payload = folder.append_child("wpml:payloadParam");
  Put(payload, "wpml:payloadPositionIndex", 0);
  Put(payload, "wpml:imageFormat", HasLenses(options.dji) ? "wide" : "visible");
  int group = 0;
  for (size_t i = 0; i < route.stops.size(); ++i) {
    const MissionStop& stop = route.stops[i];
    pugi::xml_node placemark = AddPlacemark(folder, stop, i);
    Put(placemark, "wpml:useGlobalHeight", 0);
    // DJI's own files repeat the relative height here in this height mode.
    PutHeight(placemark, "wpml:ellipsoidHeight", stop.height_m);
    PutHeight(placemark, "wpml:height", stop.height_m);
    Put(placemark, "wpml:useGlobalSpeed", 1);
    Put(placemark, "wpml:useGlobalHeadingParam", 0);
    AddHeading(placemark, "wpml:waypointHeadingParam", stop.yaw_deg, options);
    Put(placemark, "wpml:useGlobalTurnParam", 0);
    AddTurnMode(placemark);
    Put(placemark, "wpml:useStraightLine", 1);
    PutAngle(placemark, "wpml:gimbalPitchAngle",
             stop.views.empty() ? 0 : stop.views.front().pitch_deg);
    if (!stop.views.empty()) AddActions(placemark, stop, i, group++, options);
  }
}

}  // namespace

std::string WpmlTemplate(const Plan& plan, const MissionRoute& route,
                         const MissionOptions& options) {
  pugi::xml_document xml;
  pugi::xml_node document = AddDocument(xml);
  Put(document, "wpml:author", "Stucco");
  Put(document, "wpml:createTime", options.created_ms);
  Put(document, "wpml:updateTime", options.created_ms);
  AddConfig(document, &plan, route, options);
  AddTemplateFolder(document, route, options);
  return Text(xml);
}

std::string WpmlWaylines(const MissionRoute& route, const MissionOptions& options) {
  pugi::xml_document xml;
  pugi::xml_node document = AddDocument(xml);
  AddConfig(document, nullptr, route, options);
  pugi::xml_node folder = document.append_child("Folder");
  Put(folder, "wpml:templateId", 0);
  Put(folder, "wpml:executeHeightMode", "relativeToStartPoint");
  Put(folder, "wpml:waylineId", 0);
  PutDecimal(folder, "wpml:distance", route.length_m, 1);
  PutDecimal(folder, "wpml:duration", 60 * route.time_min, 1);
  PutDecimal(folder, "wpml:autoFlightSpeed", options.pace.speed_m_per_s, 1);
  int group = 0;
  for (size_t i = 0; i < route.stops.size(); ++i) {
    const MissionStop& stop = route.stops[i];
    pugi::xml_node placemark = AddPlacemark(folder, stop, i);
    PutHeight(placemark, "wpml:executeHeight", stop.height_m);
    PutDecimal(placemark, "wpml:waypointSpeed", options.pace.speed_m_per_s, 1);
    AddHeading(placemark, "wpml:waypointHeadingParam", stop.yaw_deg, options);
    AddTurnMode(placemark);
    Put(placemark, "wpml:useStraightLine", 1);
    if (!stop.views.empty()) AddActions(placemark, stop, i, group++, options);
  }
  return Text(xml);
}

void WriteWpmlKmz(const Plan& plan, const MissionRoute& route, const MissionOptions& options,
                  const std::filesystem::path& path) {
  if (options.dji.drone == 0) {
    throw Error(ErrorKind::kUsage, path.string() + ": DJI's files do not know this drone");
  }
  internal::WriteZip(path, {{"wpmz/template.kml", WpmlTemplate(plan, route, options)},
                            {"wpmz/waylines.wpml", WpmlWaylines(route, options)}});
}

}  // namespace stucco::plan
