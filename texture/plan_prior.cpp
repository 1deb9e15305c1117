// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/plan_prior.h"

#include <algorithm>

namespace stucco {

bool IsPlannedFor(const Facet& facet, const SurveyPhoto& photo) {
  // A wall that is no part of the plan has its own id there.
  if (facet.facade == facet.id) return false;
  return std::ranges::any_of(photo.planned_facades, [&](const std::string& facade) {
    return facade == facet.facade ||
           std::ranges::find(facet.other_facades, facade) != facet.other_facades.end();
  });
}

std::vector<float> PriorCosts(const Facet& facet, std::span<const SurveyPhoto> photos,
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
