// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "plan/make_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <iterator>
#include <numbers>

#include "plan/baseline/dronescan.h"
#include "plan/baseline/oblique.h"
#include "plan/dipping/dipping_views.h"
#include "plan/evaluate/evaluate_facades.h"
#include "plan/evaluate/target_all.h"
#include "plan/match/expected_matches.h"
#include "plan/match/link_photos.h"
#include "plan/path/flights.h"
#include "plan/plan_of_map.h"
#include "plan/planar/planar_views.h"
#include "plan/safety/error_budget.h"
#include "plan/safety/warnings.h"
#include "survey/error.h"
#include "survey/intervals.h"

namespace stucco::plan {
namespace {

constexpr double kDegrees = 180 / std::numbers::pi;

// Everything that planning goes by.
struct Task {
  const Site& site;
  const PlanOptions& options;
  CameraPreset camera;
  double d_max_m = 0;
  int threads = 1;
};

GridOptions GridOf(const PlanOptions& options) {
  return {options.forward_overlap, options.side_overlap};
}

// Where the ground is farther away than walls may be, it still has to be reconstructed.
double PlanarReach(const Task& task) {
  constexpr double kTilted = 3;  // heights to what a photo tilted by 45 degrees shows on top
  return std::max(task.d_max_m, kTilted * task.site.safe_altitude_m);
}

void Link(const MatchSetting& setting, const Obstacles& obstacles, std::vector<Hover>& hovers,
          Progress& progress) {
  const LinkReport report = AddLinkPhotos(setting, obstacles, hovers, progress);
  progress.Note(
      fmt::format("{} link photos, {} stops take nothing else", report.photos, report.stops));
}

std::vector<Hover> Cocapture(const Task& task, Progress& progress) {
  const Obstacles obstacles(task.site);
  DippingSetting setting = MakeSetting(task.site, obstacles, task.camera, task.d_max_m);
  setting.vertical_step = task.options.vertical_step;
  setting.threads = task.threads;
  DippingReport dipping = PlanDippingViews(setting, progress);
  progress.Note(
      fmt::format("{} dipping points of {} candidates, optimised in {} rounds and {:.2f} s",
                  dipping.points, dipping.candidates, dipping.rounds, dipping.optimise_s));
  std::vector<Hover> hovers = std::move(dipping.hovers);
  const MatchSetting matches{task.site, task.camera, task.threads};
  if (task.options.links) LinkFacades(matches, obstacles, hovers, progress);
  const PlanarOptions planar = {.grid = GridOf(task.options),
                                .d_max_m = PlanarReach(task),
                                .tau_r = task.options.reconstructability,
                                .threads = task.threads};
  std::vector<Hover> above = PlanarViews(task.site, task.camera, planar, hovers, progress);
  std::move(above.begin(), above.end(), std::back_inserter(hovers));
  if (task.options.links) Link(matches, obstacles, hovers, progress);
  return hovers;
}

std::vector<Hover> PlanViews(const Task& task, Progress& progress) {
  std::vector<Hover> hovers;
  if (task.options.method == "oblique") {
    hovers = ObliqueViews(task.site, task.camera, GridOf(task.options));
  } else if (task.options.method == "dronescan") {
    hovers = DroneScanViews(task.site, task.camera, {.d_max_m = PlanarReach(task)}, task.threads,
                            progress);
  } else {
    hovers = Cocapture(task, progress);
  }
  if (!hovers.empty()) return hovers;
  throw Error(ErrorKind::kBadInput, "the site has no place from which anything could be captured",
              "look for no-fly polygons that cover it, or lower d_min_m");
}

// What no dipping view captures of each facade, as it was planned.
std::vector<Intervals> NotDippedAt(const Site& site, const std::vector<Hover>& hovers) {
  constexpr double kLeastGapM = 0.05;
  std::vector<Intervals> captured(site.facades.size());
  for (const Hover& hover : hovers) {
    for (const Shot& shot : hover.shots) {
      if (shot.kind != ViewKind::kDipping) continue;
      for (const Target& target : shot.targets) captured[target.facade].push_back(target.along_m);
    }
  }
  std::vector<Intervals> gaps;
  for (size_t i = 0; i < captured.size(); ++i) {
    gaps.push_back(Gaps(Union(std::move(captured[i])), {0, site.facades[i].length_m()}));
    std::erase_if(gaps.back(), [](const Interval& gap) { return gap.length_m() < kLeastGapM; });
  }
  return gaps;
}

// What the photos are meant for besides, once it is known which can be flown.
void Assign(const Task& task, std::vector<Hover>& hovers) {
  if (task.options.method == "cocapture") {
    // Walls that nothing is meant for, such as those of narrow streets, get the photos from above
    // that see them best.
    AssignViews(task.site, task.camera, task.d_max_m, hovers, task.threads);
  } else {
    TargetAllSeen(task.site, task.camera, task.d_max_m, hovers, task.threads);
  }
}

PlannedView MakeView(const Site& site, const Hover& hover, size_t index, size_t shot_index) {
  const Shot& shot = hover.shots[shot_index];
  PlannedView view;
  view.id = fmt::format("h{:04}v{}", index + 1, shot_index + 1);
  view.position_m = hover.position;
  view.yaw_deg = shot.yaw_rad * kDegrees;
  view.pitch_deg = shot.pitch_rad * kDegrees;
  view.kind = shot.kind;
  view.hover = static_cast<int>(index);
  for (const Target& target : shot.targets) {
    view.targets.push_back({site.facades[target.facade].id, target.along_m, target.z_m});
  }
  return view;
}

// Views in order of capture; `flight_of_hover` as the flights have them.
void AddViews(const Site& site, const FlightPlan& path, Plan& plan) {
  std::vector<int> flight_of_hover(path.hovers.size(), 0);
  for (size_t flight = 0; flight < path.flights.size(); ++flight) {
    for (const PlannedWaypoint& waypoint : path.flights[flight].waypoints) {
      if (waypoint.hover >= 0) flight_of_hover[waypoint.hover] = static_cast<int>(flight);
    }
  }
  for (size_t i = 0; i < path.hovers.size(); ++i) {
    for (size_t k = 0; k < path.hovers[i].shots.size(); ++k) {
      PlannedView view = MakeView(site, path.hovers[i], i, k);
      view.order = static_cast<int>(plan.views.size());
      view.flight = flight_of_hover[i];
      plan.views.push_back(std::move(view));
    }
  }
}

// What is known of the facades once it is known which views are meant for them.
void AddFacades(const Task& task, const std::vector<Intervals>& unobservable,
                const std::vector<Hover>& hovers, Plan& plan) {
  const std::vector<FacadeReport> reports =
      EvaluateFacades(task.site, task.camera, task.d_max_m, hovers, task.threads);
  std::vector<std::vector<std::string>> meant(task.site.facades.size());
  size_t order = 0;
  for (const Hover& hover : hovers) {
    for (const Shot& shot : hover.shots) {
      const std::string& id = plan.views[order++].id;
      for (const Target& target : shot.targets) {
        std::vector<std::string>& ids = meant[target.facade];
        if (ids.empty() || ids.back() != id) ids.push_back(id);
      }
    }
  }
  for (size_t i = 0; i < task.site.facades.size(); ++i) {
    PlannedFacade& planned = plan.facades[i];
    planned.views = std::move(meant[i]);
    planned.predicted = reports[i].meant;
    if (task.options.method == "cocapture") planned.unobservable_m = unobservable[i];
  }
}

PlannedPace PaceOf(const PlanOptions& options) {
  PlannedPace pace;
  pace.wind_m_per_s = options.wind_m_per_s;
  return pace;
}

Plan DescribeSite(const Task& task) {
  Plan plan = PlanOfMap(task.site);
  plan.method = task.options.method;
  plan.camera = task.camera.camera;
  plan.d_max_m = task.d_max_m;
  return plan;
}

void AddSafety(const Task& task, PlanResult& result) {
  const ErrorBudget budget = BudgetOf(task.options);
  result.stats.horizontal_error_m = budget.horizontal_m;
  result.stats.vertical_error_m = budget.vertical_m;
  if (task.site.terrain.IsFlat()) result.stats.flat_within_m = budget.flatness_m;
  result.stats.warnings = SafetyWarnings(task.site, result.plan, task.options);
}

double DMax(const PlanOptions& options, const CameraPreset& camera) {
  const double d_max = options.d_max_m > 0 ? options.d_max_m : camera.DistanceForGsd(options.gsd_m);
  if (d_max > options.d_min_m) return d_max;
  throw Error(ErrorKind::kUsage,
              fmt::format("a pixel of {} covers {:.4f} m only up to a distance of {:.1f} m, but "
                          "buildings are kept {:.1f} m away (d_min_m)",
                          camera.camera.label, options.gsd_m, d_max, options.d_min_m),
              "ask for a coarser gsd_m, or take a camera with a longer focal length");
}

}  // namespace

PlanResult MakePlan(const Site& site, const PlanOptions& options, int threads, Progress& progress) {
  const auto start = std::chrono::steady_clock::now();
  Task task{site, options, FindCamera(options.camera), 0, threads};
  task.d_max_m = DMax(options, task.camera);
  std::vector<SunDay> days = SunDays(options.date);
  // The tour keeps photos of a facade together, so they have to be assigned before it; where
  // no-fly polygons cut some off, the others stand in.
  std::vector<Hover> hovers = PlanViews(task, progress);
  Assign(task, hovers);
  const size_t planned = hovers.size();
  const Battery battery{task.camera.battery_scale, options.battery_percent, PaceOf(options)};
  FlightPlan path = PlanFlights(site, battery, std::move(hovers), threads, progress);
  const std::vector<Intervals> unobservable = NotDippedAt(site, path.hovers);
  if (path.hovers.size() < planned && options.method == "cocapture") Assign(task, path.hovers);
  PlanResult result;
  result.days = std::move(days);
  result.plan = DescribeSite(task);
  result.plan.flights = path.flights;
  result.plan.pace = battery.pace;
  AddViews(site, path, result.plan);
  AddFacades(task, unobservable, path.hovers, result.plan);
  const PhotoGraph photos({site, task.camera, threads}, path.hovers);
  const MatchStats matches = ExpectMatches(photos, path.hovers, threads, result.plan);
  result.coverage = CoverageOf(photos, task.camera.camera);
  result.flights = FactsOf(result.plan, site.terrain);
  const std::chrono::duration<double> taken = std::chrono::steady_clock::now() - start;
  result.stats = StatsOf(result.plan, taken.count(), path.tour.gap());
  AddSafety(task, result);
  result.stats.matches = matches;
  const bool links_tried = options.links && options.method == "cocapture";
  std::ranges::move(MatchWarnings(matches, links_tried), std::back_inserter(result.stats.warnings));
  std::ranges::move(CoverageWarnings(result.coverage, options.gsd_m),
                    std::back_inserter(result.stats.warnings));
  return result;
}

}  // namespace stucco::plan
