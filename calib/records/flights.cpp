// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/flights.h"

#include <algorithm>
#include <map>
#include <string>

namespace stucco {
namespace {

constexpr double kPause_s = 300;

// Photos in the order they were taken, those without a time by their order in the captures.
std::vector<int> InTime(const std::vector<const CapturedPhoto*>& captures,
                        const std::vector<TakenIn>& taken) {
  std::vector<int> order(captures.size());
  for (size_t i = 0; i < order.size(); ++i) order[i] = static_cast<int>(i);
  std::stable_sort(order.begin(), order.end(), [&](int a, int b) {
    if (captures[a]->camera != captures[b]->camera)
      return captures[a]->camera < captures[b]->camera;
    return taken[a].time_s.value_or(0) < taken[b].time_s.value_or(0);
  });
  return order;
}

}  // namespace

std::vector<TakenIn> ReadFlights(const std::vector<const CapturedPhoto*>& captures,
                                 const Plan* plan) {
  std::map<std::string, int> flight_of_view;
  if (plan != nullptr) {
    for (const PlannedView& view : plan->views) flight_of_view[view.id] = view.flight;
  }
  std::vector<TakenIn> taken(captures.size());
  for (size_t i = 0; i < captures.size(); ++i) {
    taken[i].time_s = CaptureTime_s(*captures[i]);
  }
  // A flight is a planned one on a day without a long pause, by one camera.
  int flight = 0;
  int order = 0;
  int planned = -1;
  int before = -1;
  for (const int i : InTime(captures, taken)) {
    const auto found = flight_of_view.find(captures[i]->view);
    const int now = found == flight_of_view.end() ? planned : found->second;
    if (before >= 0) {
      const std::optional<double>& now_s = taken[i].time_s;
      const std::optional<double>& before_s = taken[before].time_s;
      const bool paused = now_s && before_s && *now_s - *before_s > kPause_s;
      const bool other = planned >= 0 && now != planned;
      flight += paused || other || captures[i]->camera != captures[before]->camera;
    }
    taken[i].flight = flight;
    taken[i].order = order++;
    planned = now;
    before = i;
  }
  return taken;
}

}  // namespace stucco
