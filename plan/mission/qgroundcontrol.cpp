// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/qgroundcontrol.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <vector>

#include "survey/geometry2d.h"

namespace stucco::plan {
namespace {

using Json = nlohmann::ordered_json;

// MAV_CMD, MAV_FRAME and the other numbers of MAVLink.
enum Command {
  kWaypoint = 16,
  kReturn = 20,
  kTakeOff = 22,
  kDelay = 93,
  kSpeed = 178,
  kGimbal = 205,  // DO_MOUNT_CONTROL: older than the gimbal manager, and understood by more
  kImage = 2000,
};
enum Frame { kMissionFrame = 2, kRelativeToHome = 3 };
constexpr int kPx4 = 12;
constexpr int kQuadrotor = 2;
constexpr int kRelativeAltitude = 1;
constexpr int kMavlinkTargeting = 2;

double Degrees8(double degrees) {
  return std::round(degrees * 1e8) / 1e8;
}
double Centi(double value) {
  return std::round(value * 100) / 100 + 0.0;
}

Json Position(const Geodetic& point) {
  return Json::array({Degrees8(point.latitude_deg), Degrees8(point.longitude_deg)});
}

class Items {
 public:
  void AddCommand(Command command, std::vector<Json> params) {
    params.resize(7, 0);
    Add(command, kMissionFrame, params);
  }
  void AddPlace(Command command, const std::vector<Json>& first, const Geodetic& point,
                double height_m) {
    std::vector<Json> params = first;
    params.resize(4, 0);
    for (const Json& degrees : Position(point)) params.push_back(degrees);
    params.push_back(Centi(height_m));
    Json& item = Add(command, kRelativeToHome, params);
    item["Altitude"] = Centi(height_m);
    item["AltitudeMode"] = kRelativeAltitude;
    item["AMSLAltAboveTerrain"] = nullptr;
  }
  Json Take() { return std::move(items_); }

 private:
  Json& Add(Command command, Frame frame, const std::vector<Json>& params) {
    items_.push_back({{"type", "SimpleItem"},
                      {"autoContinue", true},
                      {"command", static_cast<int>(command)},
                      {"doJumpId", items_.size() + 1},
                      {"frame", static_cast<int>(frame)},
                      {"params", params}});
    return items_.back();
  }

  Json items_ = Json::array();
};

void AddStop(const MissionStop& stop, const MissionOptions& options, Items& items) {
  const double hold_s = 0;  // the wait comes after the gimbal has its order
  items.AddPlace(kWaypoint, {hold_s, 0, 0, Centi(CompassDegrees(stop.yaw_deg))}, stop.geodetic,
                 stop.height_m);
  double yaw = stop.yaw_deg;
  const PlannedView* before = nullptr;
  for (const PlannedView& view : stop.views) {
    // PX4 turns on the spot at a waypoint that differs in yaw alone.
    if (std::abs(SignedDegrees(view.yaw_deg - yaw)) > kSmallTurn_deg) {
      items.AddPlace(kWaypoint, {hold_s, 0, 0, Centi(CompassDegrees(view.yaw_deg))}, stop.geodetic,
                     stop.height_m);
      yaw = view.yaw_deg;
    }
    if (before == nullptr || std::abs(view.pitch_deg - before->pitch_deg) > kSmallTurn_deg) {
      items.AddCommand(kGimbal, {Centi(view.pitch_deg), 0, 0, 0, 0, 0, kMavlinkTargeting});
    }
    items.AddCommand(kDelay, {options.pace.hold_s, -1, -1, -1});
    items.AddCommand(kImage, {0, 0, 1, view.order + 1});
    before = &view;
  }
}

// QGroundControl wants fences clockwise.
Json FencePolygon(const Plan& plan, const Ring& ring, bool inclusion) {
  std::vector<Json> corners;
  corners.reserve(ring.size());
  for (const Eigen::Vector2d& corner : ring) {
    corners.push_back(Position(GeodeticFromPlan(plan.origin, corner)));
  }
  if (SignedArea(ring) > 0) std::ranges::reverse(corners);
  return {{"inclusion", inclusion}, {"polygon", corners}, {"version", 1}};
}

// What a no-fly area closes in is closed to the drone as well, unless the flight takes place there:
// fences have no holes.
Json FenceOf(const Plan& plan, const Polygon& zone, const Eigen::Vector2d& home) {
  for (size_t hole = 1; hole < zone.rings.size(); ++hole) {
    if (Contains(Polygon{{zone.rings[hole]}}, home)) {
      return FencePolygon(plan, zone.rings[hole], true);
    }
  }
  return FencePolygon(plan, zone.rings.front(), false);
}

}  // namespace

std::string QGroundControlPlan(const Plan& plan, const MissionRoute& route,
                               const MissionOptions& options) {
  const Geodetic home = GeodeticFromPlan(plan.origin, route.home_m.head<2>());
  Items items;
  items.AddPlace(kTakeOff, {0, 0, 0, nullptr}, home, route.take_off_height_m);
  items.AddCommand(kSpeed, {1, options.pace.speed_m_per_s, -1});
  for (const MissionStop& stop : WithApproach(plan, route, route.stops)) {
    AddStop(stop, options, items);
  }
  items.AddCommand(kReturn, {});
  Json polygons = Json::array();
  for (const Polygon& zone : PolygonsOf(plan.no_fly_m)) {
    polygons.push_back(FenceOf(plan, zone, route.home_m.head<2>()));
  }
  const Json json = {
      {"fileType", "Plan"},
      {"version", 1},
      {"groundStation", "QGroundControl"},
      {"mission",
       {{"version", 2},
        {"firmwareType", kPx4},
        {"vehicleType", kQuadrotor},
        {"cruiseSpeed", options.pace.transfer_speed_m_per_s},
        {"hoverSpeed", options.pace.speed_m_per_s},
        {"globalPlanAltitudeMode", kRelativeAltitude},
        {"plannedHomePosition",
         {Degrees8(home.latitude_deg), Degrees8(home.longitude_deg),
          Centi(plan.origin.height_m + route.home_m.z())}},
        {"items", items.Take()}}},
      {"geoFence", {{"version", 2}, {"circles", Json::array()}, {"polygons", polygons}}},
      {"rallyPoints", {{"version", 2}, {"points", Json::array()}}},
  };
  return json.dump(1) + "\n";
}

}  // namespace stucco::plan
