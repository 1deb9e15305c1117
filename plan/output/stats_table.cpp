// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "plan/output/stats.h"

namespace stucco::plan {
namespace {

constexpr size_t kWorstFacades = 8;
// Shorter parts are corners that hide behind a drainpipe, not news.
constexpr double kNoteworthy = 0.5;  // metres

// A wall of which more is hidden is news of the map, not of the plan.
constexpr double kHidden = 0.9;

std::string Row(const char* name, const std::string& value) {
  return fmt::format("  {:<16}{}\n", name, value);
}

std::string Kinds(const PlanStats& stats) {
  std::vector<std::string> parts;
  for (const auto& [kind, count] : stats.photos_by_kind) {
    parts.push_back(fmt::format("{} {}", count, kind));
  }
  return fmt::format("{}", fmt::join(parts, ", "));
}

std::string Energy(const PlanStats& stats) {
  const size_t flights = stats.battery_by_flight.size();
  std::string text = fmt::format("{:.0f} % of a battery, {} flight{}", stats.battery_percent,
                                 flights, flights == 1 ? "" : "s");
  if (flights < 2) return text;
  const auto [low, high] = std::ranges::minmax(stats.battery_by_flight);
  return text + fmt::format(" of {:.0f} to {:.0f} %", low, high);
}

std::string Matches(const MatchStats& matches) {
  const std::string loose =
      matches.loose == 0 ? "no photo is loose" : fmt::format("loose photos: {}", matches.loose);
  if (matches.parts <= 1 && matches.bridges == 0 && matches.hanging == 0) {
    return loose + ", all hang together";
  }
  return loose + fmt::format(", parts: {}, bridges: {}, photos that hang on one hover: {}",
                             matches.parts, matches.bridges, matches.hanging);
}

std::string Time(const PlanStats& stats) {
  const PlannedTime& parts = stats.parts;
  return fmt::format(
      "{:.1f} min: {:.1f} photos, {:.1f} stops and turns, {:.1f} legs, {:.1f} transfer",
      stats.time_min, parts.photos_min, parts.stops_min, parts.legs_min, parts.transfer_min);
}

std::string Assumed(const PlannedPace& pace) {
  return fmt::format("{:g} m/s, {:.1f} s a photo besides turns, {:.1f} s a stop, wind {:g} m/s",
                     pace.speed_m_per_s, pace.hold_s + pace.shutter_s, pace.stop_s,
                     pace.wind_m_per_s);
}

std::string FacadeRow(const FacadeStats& facade, size_t id_width) {
  const FacadeQuality& q = facade.quality;
  return fmt::format(
      "  {:<{}}{:>8.1f} {:>6}  {:>5.2f} {:>5.2f} {:>5.2f} {:>5.2f} {:>6.2f} {:>9.1f}\n", facade.id,
      id_width, facade.length_m, facade.views, q.q_s, q.q_d, q.q_u, q.q_c, q.sum(),
      facade.UnobservableLength());
}

// What needs a look first: the lowest sum of terms, among walls that can be seen at all.
std::string WorstFacades(const PlanStats& stats) {
  std::vector<FacadeStats> facades = stats.facades;
  std::erase_if(facades, [](const FacadeStats& facade) {
    return facade.UnobservableLength() > kHidden * facade.length_m;
  });
  std::ranges::stable_sort(facades, {},
                           [](const FacadeStats& facade) { return facade.quality.sum(); });
  facades.resize(std::min(facades.size(), kWorstFacades));
  if (facades.empty()) return {};
  size_t id_width = 16;
  for (const FacadeStats& facade : facades) id_width = std::max(id_width, facade.id.size() + 1);
  std::string text =
      fmt::format("\n  {:<{}}{:>8} {:>6}  {:>5} {:>5} {:>5} {:>5} {:>6} {:>9}\n", "worst facades",
                  id_width, "length", "views", "Q_s", "Q_d", "Q_u", "Q_c", "Q", "unseen m");
  for (const FacadeStats& facade : facades) text += FacadeRow(facade, id_width);
  return text;
}

}  // namespace

std::string StatsTable(const PlanStats& stats) {
  std::string text = fmt::format("{}, {}\n", stats.method, stats.camera);
  text += Row("photos", fmt::format("{} ({})", stats.photos, Kinds(stats)));
  text += Row("matches", Matches(stats.matches));
  text += Row("hovers", fmt::format("{}", stats.hovers));
  text += Row("path", fmt::format("{:.0f} m", stats.length_m));
  text += Row("time", Time(stats));
  text += Row("energy", Energy(stats));
  text += Row("assumed", Assumed(stats.pace));
  text += Row("tour", fmt::format("{:.1f} % above its lower bound", 100 * stats.tsp_gap));
  text += Row("planned in", fmt::format("{:.1f} s", stats.planning_s));
  if (stats.facades.empty()) return text + Row("facades", "none");
  const FacadeQuality& q = stats.mean;
  text += Row("facades", fmt::format("{}, mean Q {:.2f} of 4 (Q_s {:.2f}, Q_d {:.2f}, Q_u {:.2f}, "
                                     "Q_c {:.2f})",
                                     stats.facades.size(), q.sum(), q.q_s, q.q_d, q.q_u, q.q_c));
  const auto parts = std::ranges::count_if(stats.facades, [](const FacadeStats& facade) {
    return facade.UnobservableLength() > kNoteworthy;
  });
  text += Row("from above only", fmt::format("{:.1f} of {:.1f} m of wall, on {} facades",
                                             stats.unobservable_m, stats.wall_m, parts));
  return text + WorstFacades(stats);
}

}  // namespace stucco::plan
