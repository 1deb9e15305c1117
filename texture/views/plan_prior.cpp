// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/views/plan_prior.h"

#include <algorithm>

namespace stucco {

bool IsPlannedFor(const Facet& facet, const SurveyPhoto& photo) {
  return std::ranges::any_of(photo.planned_facades, [&](const std::string& facade) {
    return std::ranges::find(facet.planned_facades, facade) != facet.planned_facades.end();
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
