// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/plan_prior.h"

#include <algorithm>

namespace stucco {

void KnowPlan(const Plan& plan, const std::map<std::string, CapturedPhoto>& captures,
              std::span<TexturePhoto> photos) {
  std::map<std::string, const PlannedView*> views;
  for (const PlannedView& view : plan.views) views[view.id] = &view;
  for (TexturePhoto& photo : photos) {
    photo.facades.clear();
    const auto captured = captures.find(photo.name);
    if (captured == captures.end()) continue;
    const auto view = views.find(captured->second.view);
    if (view == views.end()) continue;
    for (const PlannedTarget& target : view->second->targets) {
      photo.facades.push_back(target.facade);
    }
  }
}

bool IsPlannedFor(const Facet& facet, const TexturePhoto& photo) {
  // A wall that is no part of the plan has its own id there.
  if (facet.facade == facet.id) return false;
  return std::ranges::any_of(photo.facades, [&](const std::string& facade) {
    return facade == facet.facade ||
           std::ranges::find(facet.other_facades, facade) != facet.other_facades.end();
  });
}

std::vector<float> PriorCosts(const Facet& facet, std::span<const TexturePhoto> photos,
                              std::span<const int> indices) {
  std::vector<float> costs;
  bool any = false;
  for (const int index : indices) {
    const bool planned = IsPlannedFor(facet, photos[index]);
    any |= planned;
    costs.push_back(planned ? 0 : kUnplannedCost);
  }
  if (!any) costs.assign(costs.size(), 0);
  return costs;
}

}  // namespace stucco
