// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/output/stats.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <set>

#include "survey/files.h"
#include "survey/numbers.h"

namespace stucco::plan {
namespace {

using Json = nlohmann::ordered_json;

double Metres(double value) {
  return RoundTo(value, 1e3);
}
double Share(double value) {
  return RoundTo(value, 1e4);
}

void AddScaled(const FacadeQuality& quality, double weight, FacadeQuality& sum) {
  sum.q_s += weight * quality.q_s;
  sum.q_d += weight * quality.q_d;
  sum.q_u += weight * quality.q_u;
  sum.q_c += weight * quality.q_c;
}

void AddFacades(const Plan& plan, PlanStats& stats) {
  for (const PlannedFacade& facade : plan.facades) {
    const double length = facade.length_m();
    stats.facades.push_back({facade.id, length, static_cast<int>(facade.views.size()),
                             facade.predicted, facade.unobservable_m});
    stats.wall_m += length;
    stats.unobservable_m += stats.facades.back().UnobservableLength();
  }
  for (const FacadeStats& facade : stats.facades) {
    AddScaled(facade.quality, 1 / static_cast<double>(stats.facades.size()), stats.mean);
    AddScaled(facade.quality, facade.length_m / stats.wall_m, stats.mean_by_length);
  }
}

void AddQuality(const FacadeQuality& quality, Json& json) {
  json["q_s"] = Share(quality.q_s);
  json["q_d"] = Share(quality.q_d);
  json["q_u"] = Share(quality.q_u);
  json["q_c"] = Share(quality.q_c);
}

Json QualityJson(const FacadeQuality& quality) {
  Json json = Json::object();
  AddQuality(quality, json);
  return json;
}

Json PartsJson(const std::vector<Interval>& parts) {
  Json json = Json::array();
  for (const Interval& part : parts) {
    json.push_back(Json::array({Metres(part.from_m), Metres(part.to_m)}));
  }
  return json;
}

Json PartsJson(const PlannedTime& parts) {
  return {{"transfer", Metres(parts.transfer_min)},
          {"legs", Metres(parts.legs_min)},
          {"stops", Metres(parts.stops_min)},
          {"photos", Metres(parts.photos_min)}};
}

Json AssumedJson(const PlannedPace& pace) {
  return {{"speed_m_per_s", pace.speed_m_per_s},
          {"stop_s", pace.stop_s},
          {"photo_s", Metres(pace.hold_s + pace.shutter_s)},
          {"yaw_deg_per_s", pace.yaw_deg_per_s},
          {"tilt_deg_per_s", pace.tilt_deg_per_s},
          {"wind_m_per_s", pace.wind_m_per_s}};
}

Json FacadeJson(const FacadeStats& facade) {
  Json json = {{"id", facade.id}, {"length_m", Metres(facade.length_m)}, {"views", facade.views}};
  AddQuality(facade.quality, json);
  if (!facade.unobservable_m.empty()) json["unobservable_m"] = PartsJson(facade.unobservable_m);
  return json;
}

Json MatchesJson(const MatchStats& matches) {
  Json weakest = Json::array();
  for (const TiedView& view : matches.weakest) {
    Json json = {{"view", view.view},
                 {"partners", view.partners},
                 {"strength", Share(view.strength)},
                 {"loose", view.is_loose}};
    if (!view.facades.empty()) {
      json["close"] = view.close;
      json["facades"] = view.facades;
    }
    weakest.push_back(std::move(json));
  }
  return {{"parts", matches.parts}, {"bridges", matches.bridges}, {"hanging", matches.hanging},
          {"apart", matches.apart}, {"loose", matches.loose},     {"weakest", std::move(weakest)}};
}

}  // namespace

double FacadeStats::UnobservableLength() const {
  double length = 0;
  for (const Interval& part : unobservable_m) length += part.length_m();
  return length;
}

PlanStats StatsOf(const Plan& plan, double planning_s, double tsp_gap) {
  PlanStats stats;
  stats.method = plan.method;
  stats.camera = plan.camera.label.empty() ? plan.camera.name : plan.camera.label;
  stats.photos = static_cast<int>(plan.views.size());
  std::set<int> hovers;
  for (const PlannedView& view : plan.views) {
    ++stats.photos_by_kind[std::string(Name(view.kind))];
    hovers.insert(view.hover);
  }
  stats.hovers = static_cast<int>(hovers.size());
  for (const PlannedFlight& flight : plan.flights) {
    stats.length_m += flight.length_m;
    stats.time_min += flight.time_min;
    stats.battery_percent += flight.battery_percent;
    stats.battery_by_flight.push_back(flight.battery_percent);
    stats.parts.transfer_min += flight.parts.transfer_min;
    stats.parts.legs_min += flight.parts.legs_min;
    stats.parts.stops_min += flight.parts.stops_min;
    stats.parts.photos_min += flight.parts.photos_min;
  }
  stats.pace = plan.pace;
  stats.planning_s = planning_s;
  stats.tsp_gap = tsp_gap;
  AddFacades(plan, stats);
  return stats;
}

void WriteStats(const PlanStats& stats, const std::filesystem::path& path) {
  Json json = {{"version", 1},
               {"method", stats.method},
               {"photos", stats.photos},
               {"photos_by_kind", stats.photos_by_kind},
               {"hovers", stats.hovers},
               {"length_m", Metres(stats.length_m)},
               {"time_min", Metres(stats.time_min)},
               {"time_parts_min", PartsJson(stats.parts)},
               {"battery_percent", Metres(stats.battery_percent)},
               {"flights", stats.battery_by_flight.size()},
               {"assumed", AssumedJson(stats.pace)},
               {"planning_s", Metres(stats.planning_s)},
               {"tsp_gap", RoundTo(stats.tsp_gap, 1e5)},
               {"wall_m", Metres(stats.wall_m)},
               {"unobservable_m", Metres(stats.unobservable_m)},
               {"mean", QualityJson(stats.mean)},
               {"mean_by_length", QualityJson(stats.mean_by_length)},
               {"horizontal_error_m", Metres(stats.horizontal_error_m)},
               {"vertical_error_m", Metres(stats.vertical_error_m)}};
  if (stats.flat_within_m) json["flat_within_m"] = Metres(*stats.flat_within_m);
  json["warnings"] = stats.warnings;
  json["matches"] = MatchesJson(stats.matches);
  std::string text = json.dump(1);
  text.resize(text.size() - 2);  // the closing brace: facades follow, a line each
  text += ",\n \"facades\": [";
  const char* separator = "\n  ";
  for (const FacadeStats& facade : stats.facades) {
    text += separator + FacadeJson(facade).dump();
    separator = ",\n  ";
  }
  WriteFile(path, text + "\n ]\n}\n");
}

}  // namespace stucco::plan
