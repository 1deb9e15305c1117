// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <map>
#include <nlohmann/json.hpp>
#include <vector>

#include "plan/mission/kml.h"
#include "survey/geometry2d.h"
#include "survey/numbers.h"
#include "survey/plan_frame.h"

namespace stucco::plan {
namespace {

using Json = nlohmann::ordered_json;

double Rounded(double value) {
  return RoundTo(value, 1000);
}

struct GeoJsonWriter {
  const Plan& plan;
  std::string text;

  Json At(const Eigen::Vector3d& position) const {
    const Geodetic point = GeodeticFromPlan(plan.origin, position.head<2>());
    return Json::array({RoundTo(point.longitude_deg, 1e8), RoundTo(point.latitude_deg, 1e8),
                        Rounded(plan.origin.height_m + position.z())});
  }
  Json At(const Eigen::Vector2d& position) const {
    Json point = At(Eigen::Vector3d(position.x(), position.y(), 0));
    point.erase(2);
    return point;
  }
  // A feature a line.
  void Add(const char* layer, const char* type, const Json& coordinates, const Json& properties) {
    Json all = {{"layer", layer}};
    all.update(properties);
    const Json feature = {{"type", "Feature"},
                          {"properties", all},
                          {"geometry", {{"type", type}, {"coordinates", coordinates}}}};
    text += (text.empty() ? "" : ",\n") + feature.dump();
  }
};

Json PolygonAt(const GeoJsonWriter& writer,
               const std::vector<std::vector<Eigen::Vector2d>>& rings) {
  Json coordinates = Json::array();
  for (const auto& ring : rings) {
    Json corners = Json::array();
    for (const Eigen::Vector2d& corner : ring) corners.push_back(writer.At(corner));
    if (!ring.empty()) corners.push_back(writer.At(ring.front()));
    coordinates.push_back(corners);
  }
  return coordinates;
}

void AddViews(GeoJsonWriter& writer) {
  std::map<int, std::vector<const PlannedView*>> hovers;
  for (const PlannedView& view : writer.plan.views) {
    Json facades = Json::array();
    for (const PlannedTarget& target : view.targets) facades.push_back(target.facade);
    hovers[view.hover].push_back(&view);
    writer.Add("view", "Point", writer.At(view.position_m),
               {{"id", view.id},
                {"kind", Name(view.kind)},
                {"yaw_deg", Rounded(view.yaw_deg)},
                {"pitch_deg", Rounded(view.pitch_deg)},
                {"z_m", Rounded(view.position_m.z())},
                {"hover", view.hover},
                {"order", view.order},
                {"flight", view.flight},
                {"facades", facades}});
  }
  for (const auto& [hover, views] : hovers) {
    writer.Add("hover", "Point", writer.At(views.front()->position_m),
               {{"hover", hover}, {"flight", views.front()->flight}, {"photos", views.size()}});
  }
}

void AddPaths(GeoJsonWriter& writer) {
  for (size_t i = 0; i < writer.plan.flights.size(); ++i) {
    const PlannedFlight& flight = writer.plan.flights[i];
    if (flight.waypoints.size() < 2) continue;
    Json line = Json::array();
    for (const PlannedWaypoint& waypoint : flight.waypoints) {
      line.push_back(writer.At(waypoint.position_m));
    }
    writer.Add("path", "LineString", line,
               {{"flight", i},
                {"length_m", Rounded(flight.length_m)},
                {"time_min", Rounded(flight.time_min)},
                {"battery_percent", Rounded(flight.battery_percent)}});
  }
}

void AddFacades(GeoJsonWriter& writer) {
  for (const PlannedFacade& facade : writer.plan.facades) {
    const FacadeQuality& q = facade.predicted;
    double unobservable_m = 0;
    for (const Interval& part : facade.unobservable_m) unobservable_m += part.length_m();
    writer.Add("facade", "LineString", Json::array({writer.At(facade.a_m), writer.At(facade.b_m)}),
               {{"id", facade.id},
                {"q", Rounded(q.sum())},
                {"q_s", Rounded(q.q_s)},
                {"q_d", Rounded(q.q_d)},
                {"q_u", Rounded(q.q_u)},
                {"q_c", Rounded(q.q_c)},
                {"views", facade.views.size()},
                {"foot_m", Rounded(facade.z_m.from_m)},
                {"top_m", Rounded(facade.z_m.to_m)},
                {"unobservable_m", Rounded(unobservable_m)}});
  }
}

}  // namespace

std::string PlanGeoJson(const Plan& plan) {
  GeoJsonWriter writer = {plan, ""};
  for (const PlannedFootprint& footprint : plan.footprints) {
    writer.Add(footprint.is_obstacle ? "obstacle" : "footprint", "Polygon",
               PolygonAt(writer, footprint.rings_m),
               {{"building", footprint.building},
                {"foot_m", Rounded(footprint.z_m.from_m)},
                {"top_m", Rounded(footprint.z_m.to_m)}});
  }
  for (const Polygon& zone : PolygonsOf(plan.no_fly_m)) {
    writer.Add("no_fly", "Polygon", PolygonAt(writer, zone.rings), Json::object());
  }
  AddFacades(writer);
  AddPaths(writer);
  AddViews(writer);
  for (const Eigen::Vector3d& home : plan.Homes()) {
    writer.Add("home", "Point", writer.At(home), Json::object());
  }
  return "{\"type\":\"FeatureCollection\",\"features\":[\n" + writer.text + "\n]}\n";
}

}  // namespace stucco::plan
