// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/records/read_records.h"

#include <algorithm>
#include <cassert>
#include <map>
#include <string>
#include <utility>

#include "calib/records/flights.h"
#include "survey/attitude.h"

namespace stucco {
namespace {

// Photos of one planned hover in one flight have the same number.
std::vector<int> HoversOf(const std::vector<const CapturedPhoto*>& captures, const Plan* plan,
                          const std::vector<TakenIn>& flights) {
  std::vector<int> hovers(captures.size(), -1);
  if (plan == nullptr) return hovers;
  std::map<std::string, int> hover_of_view;
  for (const PlannedView& view : plan->views) hover_of_view[view.id] = view.hover;
  std::map<std::pair<int, int>, int> numbers;
  for (size_t i = 0; i < captures.size(); ++i) {
    const auto found = hover_of_view.find(captures[i]->view);
    if (found == hover_of_view.end()) continue;
    const std::pair<int, int> hover(flights[i].flight, found->second);
    hovers[i] = numbers.try_emplace(hover, static_cast<int>(numbers.size())).first->second;
  }
  return hovers;
}

}  // namespace

std::vector<PoseRecord> ReadRecords(const std::vector<const CapturedPhoto*>& captures,
                                    const Plan* plan, const Scene& scene) {
  assert(captures.size() == scene.photos.size());
  const std::vector<TakenIn> flights = ReadFlights(captures, plan);
  const std::vector<int> hovers = HoversOf(captures, plan, flights);
  std::vector<PoseRecord> records(captures.size());
  for (size_t i = 0; i < captures.size(); ++i) {
    records[i].position = scene.photos[i].prior;
    if (captures[i]->gimbal) records[i].gimbal = CamFromEnu(*captures[i]->gimbal);
    records[i].flight = flights[i].flight;
    records[i].hover = hovers[i];
  }
  return records;
}

}  // namespace stucco
