// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "plan/match/match_stats.h"
#include "survey/plan.h"

namespace stucco::plan {

struct FacadeStats {
  std::string id;
  double length_m = 0;
  int views = 0;
  FacadeQuality quality;
  std::vector<Interval> unobservable_m;

  double UnobservableLength() const;
};

// The figures of a plan. Everything but `planning_s` depends on the plan alone.
struct PlanStats {
  std::string method;
  std::string camera;
  int photos = 0;
  std::map<std::string, int> photos_by_kind;  // by Name(ViewKind)
  int hovers = 0;
  double length_m = 0;
  double time_min = 0;
  double battery_percent = 0;  // of all flights together
  std::vector<double> battery_by_flight;
  PlannedTime parts;  // of time_min
  PlannedPace pace;   // what time and battery rest on
  double planning_s = 0;
  double tsp_gap = 0;  // tour over its lower bound, minus 1
  double wall_m = 0;
  double unobservable_m = 0;
  FacadeQuality mean;             // over facades, each counting alike
  FacadeQuality mean_by_length;   // over metres of wall
  double horizontal_error_m = 0;  // of map and drone, both a part of d_min
  double vertical_error_m = 0;
  std::optional<double> flat_within_m;  // assumed of the ground, where there is no terrain
  std::vector<std::string> warnings;    // what to know before it is flown, a line each
  MatchStats matches;                   // expected between the photos
  std::vector<FacadeStats> facades;
};

PlanStats StatsOf(const Plan& plan, double planning_s, double tsp_gap);

// plan/stats.json (docs/formats.md).
void WriteStats(const PlanStats& stats, const std::filesystem::path& path);

// The same for a terminal: the figures, and the facades that need a look.
std::string StatsTable(const PlanStats& stats);

}  // namespace stucco::plan
