// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/plan_io.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "survey/error.h"
#include "survey/files.h"
#include "survey/internal/json.h"
#include "survey/internal/plan_check.h"
#include "survey/numbers.h"

namespace stucco {
namespace {

using Pairs = std::vector<Eigen::Vector2d>;

// Files carry millimetres and thousandths of a degree: far below what a drone can hold, and the
// same bytes where two machines differ in the last bits.
double Metres(double value) {
  return RoundTo(value, 1e3);
}
double Degrees(double value) {
  return RoundTo(value, 1e3);
}
double Share(double value) {
  return RoundTo(value, 1e4);
}
Interval Metres(const Interval& interval) {
  return {Metres(interval.from_m), Metres(interval.to_m)};
}
template <int N>
Eigen::Matrix<double, N, 1> Metres(const Eigen::Matrix<double, N, 1>& position) {
  return position.unaryExpr([](double value) { return Metres(value); });
}
template <typename T>
std::vector<T> Metres(const std::vector<T>& list) {
  std::vector<T> rounded;
  rounded.reserve(list.size());
  for (const T& element : list) rounded.push_back(Metres(element));
  return rounded;
}

void Round(PlannedFacade& facade) {
  facade.a_m = Metres(facade.a_m);
  facade.b_m = Metres(facade.b_m);
  facade.z_m = Metres(facade.z_m);
  facade.unobservable_m = Metres(facade.unobservable_m);
  FacadeQuality& quality = facade.predicted;
  for (double* term : {&quality.q_s, &quality.q_d, &quality.q_u, &quality.q_c}) {
    *term = Share(*term);
  }
}

void Round(PlannedView& view) {
  view.position_m = Metres(view.position_m);
  view.yaw_deg = Degrees(view.yaw_deg);
  view.pitch_deg = Degrees(view.pitch_deg);
  for (PlannedTarget& target : view.targets) {
    target.along_m = Metres(target.along_m);
    target.z_m = Metres(target.z_m);
  }
  for (PlannedPartner& partner : view.partners) partner.strength = Share(partner.strength);
}

void Round(PlannedFlight& flight) {
  for (PlannedWaypoint& waypoint : flight.waypoints) {
    waypoint.position_m = Metres(waypoint.position_m);
  }
  flight.length_m = Metres(flight.length_m);
  PlannedTime& parts = flight.parts;
  for (double* value :
       {&flight.time_min, &flight.battery_percent, &flight.reserve_percent, &parts.transfer_min,
        &parts.legs_min, &parts.stops_min, &parts.photos_min}) {
    *value = RoundTo(*value, 1e3);
  }
  if (flight.home_m) flight.home_m = Metres(*flight.home_m);
}

Plan Rounded(Plan plan) {
  plan.origin.height_m = Metres(plan.origin.height_m);
  for (double* length :
       {&plan.d_min_m, &plan.d_max_m, &plan.safe_altitude_m, &plan.min_altitude_m}) {
    *length = Metres(*length);
  }
  plan.home_m = Metres(plan.home_m);
  plan.no_fly_m = Metres(plan.no_fly_m);
  for (PlannedFootprint& footprint : plan.footprints) {
    footprint.rings_m = Metres(footprint.rings_m);
    footprint.z_m = Metres(footprint.z_m);
    footprint.blocked_to_m = Metres(footprint.blocked_to_m);
  }
  for (PlannedFacade& facade : plan.facades) Round(facade);
  for (PlannedView& view : plan.views) Round(view);
  for (PlannedFlight& flight : plan.flights) Round(flight);
  return plan;
}

// Each entry of a long list on a line of its own: a tenth of the lines of indented JSON, and a
// difference between two plans shows view by view.
std::string OneLinePerEntry(const internal::Json& json) {
  std::string text = "{";
  const char* separator = "\n";
  for (const auto& [name, value] : json.items()) {
    text += fmt::format("{} {}: ", separator, internal::Json(name).dump());
    separator = ",\n";
    if (!value.is_array() || value.empty() || value.front().is_number()) {
      text += value.dump();
      continue;
    }
    const char* entry_separator = "[\n";
    for (const internal::Json& entry : value) {
      text += fmt::format("{}  {}", entry_separator, entry.dump());
      entry_separator = ",\n";
    }
    text += "\n ]";
  }
  return text + "\n}\n";
}

}  // namespace

// An interval is [from, to] in the file.
template <typename Archive, internal::Is<Interval> T>
static void IntervalField(Archive& archive, const char* name, T& interval) {
  Eigen::Vector2d pair(interval.from_m, interval.to_m);
  archive.Optional(name, pair);
  if constexpr (Archive::kReads) interval = {pair.x(), pair.y()};
}

template <typename Archive, typename T>
static void IntervalsField(Archive& archive, const char* name, T& intervals) {
  Pairs pairs;
  for (const Interval& interval : intervals) pairs.emplace_back(interval.from_m, interval.to_m);
  archive.Optional(name, pairs);
  if constexpr (Archive::kReads) {
    intervals.clear();
    for (const Eigen::Vector2d& pair : pairs) intervals.push_back({pair.x(), pair.y()});
  }
}

template <typename Archive, internal::Is<PlannedTarget> T>
static void Fields(Archive& archive, T& target) {
  if constexpr (Archive::kReads) target = internal::WholeFacade("");
  archive.Required("facade", target.facade);
  IntervalField(archive, "along_m", target.along_m);
  IntervalField(archive, "z_m", target.z_m);
}

template <typename Archive, internal::Is<PlannedPartner> T>
static void Fields(Archive& archive, T& partner) {
  archive.Required("view", partner.view);
  archive.Required("strength", partner.strength);
}

template <typename Archive, internal::Is<PlannedView> T>
static void Fields(Archive& archive, T& view) {
  archive.Required("id", view.id);
  archive.Required("position_m", view.position_m);
  archive.Required("yaw_deg", view.yaw_deg);
  archive.Required("pitch_deg", view.pitch_deg);
  std::string kind(Name(view.kind));
  archive.Required("kind", kind);
  if constexpr (Archive::kReads) {
    const auto known = ViewKindFromName(kind);
    if (!known) archive.Fail("kind", fmt::format("is \"{}\", which is no known kind", kind));
    view.kind = *known;
  }
  archive.Required("hover", view.hover);
  archive.Required("order", view.order);
  archive.Required("flight", view.flight);
  std::vector<std::string> facades = internal::FacadesOf(view);
  archive.Required("facades", facades);
  archive.Optional("targets", view.targets);
  archive.Optional("partners", view.partners);
  if (Archive::kReads || view.is_loose) archive.Optional("loose", view.is_loose);
  if constexpr (Archive::kReads) {
    for (const std::string& facade : facades) {
      const auto known = internal::FacadesOf(view);
      if (std::ranges::find(known, facade) == known.end()) {
        view.targets.push_back(internal::WholeFacade(facade));
      }
    }
  }
}

template <typename Archive, internal::Is<FacadeQuality> T>
static void Fields(Archive& archive, T& quality) {
  archive.Required("q_s", quality.q_s);
  archive.Required("q_d", quality.q_d);
  archive.Required("q_u", quality.q_u);
  archive.Required("q_c", quality.q_c);
}

template <typename Archive, internal::Is<PlannedFacade> T>
static void Fields(Archive& archive, T& facade) {
  archive.Required("id", facade.id);
  archive.Required("a_m", facade.a_m);
  archive.Required("b_m", facade.b_m);
  IntervalField(archive, "z_m", facade.z_m);
  archive.Optional("top_known", facade.top_known);
  archive.Required("views", facade.views);
  archive.Optional("predicted", facade.predicted);
  IntervalsField(archive, "unobservable_m", facade.unobservable_m);
}

template <typename Archive, internal::Is<PlannedFootprint> T>
static void Fields(Archive& archive, T& footprint) {
  archive.Required("building", footprint.building);
  IntervalField(archive, "z_m", footprint.z_m);
  archive.Optional("blocked_to_m", footprint.blocked_to_m);
  if (Archive::kReads || footprint.is_obstacle) {
    archive.Optional("obstacle", footprint.is_obstacle);
  }
  archive.Required("rings_m", footprint.rings_m);
}

template <typename Archive, internal::Is<PlannedWaypoint> T>
static void Fields(Archive& archive, T& waypoint) {
  archive.Required("position_m", waypoint.position_m);
  archive.Optional("hover", waypoint.hover);
}

template <typename Archive, internal::Is<PlannedTime> T>
static void Fields(Archive& archive, T& parts) {
  archive.Optional("transfer_min", parts.transfer_min);
  archive.Optional("legs_min", parts.legs_min);
  archive.Optional("stops_min", parts.stops_min);
  archive.Optional("photos_min", parts.photos_min);
}

template <typename Archive, internal::Is<PlannedPace> T>
static void Fields(Archive& archive, T& pace) {
  archive.Optional("speed_m_per_s", pace.speed_m_per_s);
  archive.Optional("transfer_speed_m_per_s", pace.transfer_speed_m_per_s);
  archive.Optional("hold_s", pace.hold_s);
  archive.Optional("climb_m_per_s", pace.climb_m_per_s);
  archive.Optional("sink_m_per_s", pace.sink_m_per_s);
  archive.Optional("yaw_deg_per_s", pace.yaw_deg_per_s);
  archive.Optional("tilt_deg_per_s", pace.tilt_deg_per_s);
  archive.Optional("shutter_s", pace.shutter_s);
  archive.Optional("ground_s", pace.ground_s);
  archive.Optional("corner_s", pace.corner_s);
  archive.Optional("stop_s", pace.stop_s);
  archive.Optional("wind_m_per_s", pace.wind_m_per_s);
}

template <typename Archive, internal::Is<PlannedFlight> T>
static void Fields(Archive& archive, T& flight) {
  archive.Optional("length_m", flight.length_m);
  archive.Optional("time_min", flight.time_min);
  archive.Optional("battery_percent", flight.battery_percent);
  archive.Optional("reserve_percent", flight.reserve_percent);
  archive.Optional("parts", flight.parts);
  archive.Optional("home_m", flight.home_m);
  archive.Required("waypoints", flight.waypoints);
}

template <typename Archive, internal::Is<PlannedCamera> T>
static void Fields(Archive& archive, T& camera) {
  archive.Optional("name", camera.name);
  archive.Optional("label", camera.label);
  archive.Optional("focal_m", camera.focal_m);
  archive.Optional("sensor_width_m", camera.sensor_width_m);
  archive.Optional("sensor_height_m", camera.sensor_height_m);
  archive.Optional("width_px", camera.width_px);
  archive.Optional("height_px", camera.height_px);
}

template <typename Archive, internal::Is<PlanOrigin> T>
static void Fields(Archive& archive, T& origin) {
  archive.Required("latitude_deg", origin.latitude_deg);
  archive.Required("longitude_deg", origin.longitude_deg);
  archive.Optional("height_m", origin.height_m);
}

template <typename Archive, internal::Is<Plan> T>
static void Fields(Archive& archive, T& plan) {
  archive.Optional("method", plan.method);
  archive.Required("crs", plan.crs);
  archive.Required("origin", plan.origin);
  archive.Optional("camera", plan.camera);
  archive.Required("d_min_m", plan.d_min_m);
  archive.Optional("d_max_m", plan.d_max_m);
  archive.Optional("safe_altitude_m", plan.safe_altitude_m);
  archive.Optional("min_altitude_m", plan.min_altitude_m);
  archive.Optional("home_m", plan.home_m);
  archive.Required("footprints", plan.footprints);
  archive.Optional("no_fly_m", plan.no_fly_m);
  archive.Required("facades", plan.facades);
  archive.Required("views", plan.views);
  archive.Optional("pace", plan.pace);
  archive.Optional("flights", plan.flights);
}

Plan ReadPlan(const std::filesystem::path& path) {
  Plan plan = internal::ReadJsonFile<Plan>(path);
  std::stable_sort(
      plan.views.begin(), plan.views.end(),
      [](const PlannedView& one, const PlannedView& other) { return one.order < other.order; });
  internal::ResolveWholeFacades(plan);
  internal::CheckPlan(plan, path.string());
  return plan;
}

void WritePlan(const Plan& plan, const std::filesystem::path& path) {
  const Plan rounded = Rounded(plan);
  internal::CheckPlan(rounded, path.string());
  internal::Json json = internal::Json::object();
  json["version"] = internal::kJsonVersion;
  const std::string file = path.string();
  internal::JsonWriter writer(json, file);
  Fields(writer, rounded);
  WriteFile(path, OneLinePerEntry(json));
}

}  // namespace stucco
