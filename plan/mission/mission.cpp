// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/mission.h"

#include <fmt/format.h>

#include <algorithm>

#include "plan/mission/kml.h"
#include "plan/mission/litchi.h"
#include "plan/mission/qgroundcontrol.h"
#include "plan/mission/wpml_lint.h"
#include "survey/error.h"
#include "survey/files.h"

namespace stucco::plan {
namespace {

void Write(const std::filesystem::path& folder, const std::string& name, const std::string& text,
           MissionFiles& files) {
  WriteFile(folder / name, text);
  files.names.push_back(name);
}

// A file of the route with this number.
void Add(const std::string& name, size_t route, MissionFiles& files) {
  files.names.push_back(name);
  files.flights[route].names.push_back(name);
}

// DJI Fly opens no longer ones.
constexpr size_t kDjiFlyWaypoints = 200;

void WriteDji(const Plan& plan, const std::vector<MissionRoute>& routes,
              const MissionOptions& options, const std::filesystem::path& folder,
              MissionFiles& files) {
  const bool is_known =
      options.dji.drone != 0 && (options.dji.payload != 0 || options.dji.drone == kDjiFlyDrone);
  if (!is_known) {
    files.notes.push_back("no mission.kmz: DJI's mission files do not know " +
                          (plan.camera.label.empty() ? "this drone" : plan.camera.label));
    return;
  }
  for (size_t i = 0; i < routes.size(); ++i) {
    const std::string name = NumberedName("mission", ".kmz", i, routes.size());
    WriteWpmlKmz(plan, routes[i], options, folder / name);
    const std::vector<LintFinding> findings = LintKmz(folder / name);
    if (!findings.empty()) {
      throw Error(ErrorKind::kStageFailed,
                  fmt::format("{}: {}: {} ({})", (folder / name).string(), findings[0].element,
                              findings[0].text, findings[0].rule),
                  "this is a fault of the planner; please report it with the map");
    }
    Add(name, i, files);
    if (options.dji.drone == kDjiFlyDrone && routes[i].stops.size() > kDjiFlyWaypoints) {
      files.notes.push_back(fmt::format(
          "{} has {} waypoints, more than the {} of DJI Fly: plan with a smaller battery share",
          name, routes[i].stops.size(), kDjiFlyWaypoints));
    }
  }
}

// mission_2_3.csv is the third part of the second flight.
void WriteLitchi(const Plan& plan, const std::vector<MissionRoute>& routes,
                 const MissionOptions& options, const std::filesystem::path& folder,
                 MissionFiles& files) {
  std::vector<std::vector<std::string>> flights;
  flights.reserve(routes.size());
  for (const MissionRoute& route : routes) flights.push_back(LitchiCsv(plan, route, options));
  const bool has_parts =
      std::ranges::any_of(flights, [](const auto& parts) { return parts.size() > 1; });
  for (size_t i = 0; i < flights.size(); ++i) {
    for (size_t part = 0; part < flights[i].size(); ++part) {
      const std::string name = has_parts ? fmt::format("mission_{}_{}.csv", i + 1, part + 1)
                                         : NumberedName("mission", ".csv", i, flights.size());
      WriteFile(folder / name, flights[i][part]);
      Add(name, i, files);
    }
  }
  if (has_parts) {
    files.notes.push_back(
        fmt::format("Litchi holds {} waypoints in a mission: mission_1_2.csv is "
                    "the second part of flight 1",
                    kLitchiWaypoints));
  }
  for (const std::string& setting : LitchiSettings(routes.front(), options)) {
    files.notes.push_back("Litchi, to be set in the app: " + setting);
  }
}

}  // namespace

MissionFiles WriteMissionFiles(const Plan& plan, const MissionOptions& options,
                               const std::filesystem::path& folder) {
  MissionFiles files;
  std::vector<MissionRoute> routes = MissionRoutes(plan);
  for (size_t i = 0; i < routes.size(); ++i) {
    if (!routes[i].stops.empty()) files.flights.push_back({i, routes[i].return_height_m, {}});
  }
  std::erase_if(routes, [](const MissionRoute& route) { return route.stops.empty(); });
  if (routes.empty()) {
    throw Error(ErrorKind::kStageFailed, "no flight of the plan leaves the ground");
  }
  WriteDji(plan, routes, options, folder, files);
  WriteLitchi(plan, routes, options, folder, files);
  for (size_t i = 0; i < routes.size(); ++i) {
    const std::string name = NumberedName("mission", ".plan", i, routes.size());
    WriteFile(folder / name, QGroundControlPlan(plan, routes[i], options));
    Add(name, i, files);
  }
  Write(folder, "mission.kml", PlanKml(plan), files);
  Write(folder, "plan.geojson", PlanGeoJson(plan), files);
  if (!plan.no_fly_m.empty()) {
    files.notes.push_back(
        "return to home flies straight at its own height: no mission file can keep that way out "
        "of the no-fly areas, so set them in the drone's app, or fly back by hand");
  }
  return files;
}

}  // namespace stucco::plan
