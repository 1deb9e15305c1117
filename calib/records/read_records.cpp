// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/read_records.h"

#include <algorithm>
#include <cassert>
#include <ctime>
#include <iomanip>
#include <map>
#include <sstream>
#include <string>
#include <utility>

#include "survey/attitude.h"

namespace stucco {
namespace {

constexpr double kPause_s = 300;

std::optional<double> SecondsOf(const std::string& capture_time) {
  std::tm time = {};
  std::istringstream text(capture_time);
  text >> std::get_time(&time, "%Y:%m:%d %H:%M:%S");
  if (text.fail()) return std::nullopt;
  return static_cast<double>(timegm(&time));
}

// Photos in the order they were taken, those without a time by their order in the captures.
std::vector<int> InTime(const std::vector<const CapturedPhoto*>& captures,
                        const std::vector<std::optional<double>>& seconds) {
  std::vector<int> order(captures.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    if (captures[a]->camera != captures[b]->camera)
      return captures[a]->camera < captures[b]->camera;
    return seconds[a].value_or(0) < seconds[b].value_or(0);
  });
  return order;
}

std::vector<int> FlightsOf(const std::vector<const CapturedPhoto*>& captures, const Plan* plan) {
  std::map<std::string, int> flight_of_view;
  if (plan != nullptr) {
    for (const PlannedView& view : plan->views) flight_of_view[view.id] = view.flight;
  }
  std::vector<std::optional<double>> seconds;
  seconds.reserve(captures.size());
  for (const CapturedPhoto* photo : captures) seconds.push_back(SecondsOf(photo->capture_time));
  // A flight is a planned one on a day without a long pause, by one camera.
  std::vector<int> flights(captures.size(), 0);
  int flight = 0;
  int planned = -1;
  int before = -1;
  for (const int i : InTime(captures, seconds)) {
    const auto found = flight_of_view.find(captures[i]->view);
    const int now = found == flight_of_view.end() ? planned : found->second;
    if (before >= 0) {
      const bool paused =
          seconds[i] && seconds[before] && *seconds[i] - *seconds[before] > kPause_s;
      const bool other = planned >= 0 && now != planned;
      flight += paused || other || captures[i]->camera != captures[before]->camera;
    }
    flights[i] = flight;
    planned = now;
    before = i;
  }
  return flights;
}

// Photos of one planned hover in one flight have the same number.
std::vector<int> HoversOf(const std::vector<const CapturedPhoto*>& captures, const Plan* plan,
                          const std::vector<int>& flights) {
  std::vector<int> hovers(captures.size(), -1);
  if (plan == nullptr) return hovers;
  std::map<std::string, int> hover_of_view;
  for (const PlannedView& view : plan->views) hover_of_view[view.id] = view.hover;
  std::map<std::pair<int, int>, int> numbers;
  for (size_t i = 0; i < captures.size(); ++i) {
    const auto found = hover_of_view.find(captures[i]->view);
    if (found == hover_of_view.end()) continue;
    const std::pair<int, int> hover(flights[i], found->second);
    hovers[i] = numbers.try_emplace(hover, static_cast<int>(numbers.size())).first->second;
  }
  return hovers;
}

}  // namespace

std::vector<PoseRecord> ReadRecords(const std::vector<const CapturedPhoto*>& captures,
                                    const Plan* plan, const Scene& scene) {
  assert(captures.size() == scene.photos.size());
  const std::vector<int> flights = FlightsOf(captures, plan);
  const std::vector<int> hovers = HoversOf(captures, plan, flights);
  std::vector<PoseRecord> records(captures.size());
  for (size_t i = 0; i < captures.size(); ++i) {
    records[i].position = scene.photos[i].prior;
    if (captures[i]->gimbal) records[i].gimbal = CamFromEnu(*captures[i]->gimbal);
    records[i].flight = flights[i];
    records[i].hover = hovers[i];
  }
  return records;
}

}  // namespace stucco
