// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/planned_pairs.h"

#include <algorithm>
#include <map>
#include <optional>
#include <set>
#include <string>

#include "survey/plan_of_survey.h"

namespace stucco {
namespace {

// A photo and what it is meant to see of one facade.
struct Aim {
  int photo = 0;
  const PlannedTarget* target = nullptr;
};

bool Overlap(const Interval& a, const Interval& b) {
  return a.from_m < b.to_m && b.from_m < a.to_m;
}

void AddPair(int a, int b, std::set<std::pair<int, int>>& pairs) {
  if (a != b) pairs.emplace(std::min(a, b), std::max(a, b));
}

}  // namespace

std::vector<std::pair<int, int>> PairsOfPlan(const Plan& plan,
                                             const std::vector<const CapturedPhoto*>& photos) {
  std::map<std::string, int> photo_of_view;
  for (size_t i = 0; i < photos.size(); ++i) {
    if (!photos[i]->view.empty()) photo_of_view[photos[i]->view] = static_cast<int>(i);
  }
  std::map<std::string, std::vector<Aim>> by_facade;
  std::map<int, std::vector<int>> by_hover;
  for (const PlannedView& view : plan.views) {
    const auto photo = photo_of_view.find(view.id);
    if (photo == photo_of_view.end()) continue;
    by_hover[view.hover].push_back(photo->second);
    for (const PlannedTarget& target : view.targets) {
      by_facade[target.facade].push_back({photo->second, &target});
    }
  }
  std::set<std::pair<int, int>> pairs;
  for (const auto& [facade, aims] : by_facade) {
    for (size_t i = 0; i < aims.size(); ++i) {
      for (size_t k = 0; k < i; ++k) {
        if (Overlap(aims[i].target->along_m, aims[k].target->along_m) &&
            Overlap(aims[i].target->z_m, aims[k].target->z_m)) {
          AddPair(aims[i].photo, aims[k].photo, pairs);
        }
      }
    }
  }
  for (const auto& [hover, together] : by_hover) {
    for (size_t i = 0; i < together.size(); ++i) {
      for (size_t k = 0; k < i; ++k) AddPair(together[i], together[k], pairs);
    }
  }
  return {pairs.begin(), pairs.end()};
}

std::vector<std::pair<int, int>> PlannedPairs(const StageContext& context,
                                              const std::vector<const CapturedPhoto*>& photos) {
  const std::optional<Plan> plan = PlanOfSurvey(context);
  if (!plan) return {};
  return PairsOfPlan(*plan, photos);
}

}  // namespace stucco
