// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/mission/mission.h"

#include <fmt/format.h>

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

void WriteDji(const Plan& plan, const std::vector<Route>& routes, const MissionOptions& options,
              const std::filesystem::path& folder, MissionFiles& files) {
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
    files.names.push_back(name);
  }
}

void WriteLitchi(const Plan& plan, const std::vector<Route>& routes, const MissionOptions& options,
                 const std::filesystem::path& folder, MissionFiles& files) {
  std::vector<std::string> texts;
  std::string parts;
  for (size_t i = 0; i < routes.size(); ++i) {
    const size_t before = texts.size();
    for (std::string& text : LitchiCsv(plan, routes[i], options)) {
      texts.push_back(std::move(text));
    }
    if (texts.size() - before > 1) {
      parts += fmt::format(" flight {}: mission_{}.csv to mission_{}.csv;", i + 1, before + 1,
                           texts.size());
    }
  }
  for (size_t i = 0; i < texts.size(); ++i) {
    Write(folder, NumberedName("mission", ".csv", i, texts.size()), texts[i], files);
  }
  if (!parts.empty()) {
    parts.back() = '.';
    files.notes.push_back(
        fmt::format("Litchi holds {} waypoints in a mission, so flights take "
                    "several files:{}",
                    kLitchiWaypoints, parts));
  }
  for (const std::string& setting : LitchiSettings(routes.front(), options)) {
    files.notes.push_back("Litchi, to be set in the app: " + setting);
  }
}

}  // namespace

MissionFiles WriteMissionFiles(const Plan& plan, const MissionOptions& options,
                               const std::filesystem::path& folder) {
  MissionFiles files;
  std::vector<Route> routes = RoutesOf(plan);
  std::erase_if(routes, [](const Route& route) { return route.stops.empty(); });
  if (routes.empty()) {
    throw Error(ErrorKind::kStageFailed, "no flight of the plan leaves the ground");
  }
  WriteDji(plan, routes, options, folder, files);
  WriteLitchi(plan, routes, options, folder, files);
  for (size_t i = 0; i < routes.size(); ++i) {
    Write(folder, NumberedName("mission", ".plan", i, routes.size()),
          QGroundControlPlan(plan, routes[i], options), files);
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
