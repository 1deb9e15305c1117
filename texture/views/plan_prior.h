// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "survey/proxy.h"
#include "survey/survey_photo.h"

namespace stucco {

// What a photo costs more than ViewCost says, everywhere on a facet whose facade the plan means
// other photos for. On the scale of ViewCost, where no resolution at all costs 0.4 and half of the
// usual sharpness 0.1: between photos about as good as each other the planned ones win, which are
// alike and few by the plan's design; a planned photo that is visibly blurred, turned away,
// coarser by an eighth or blocked loses all the same, and one that is missing costs nothing.
inline constexpr float kUnplannedCost = 0.05f;

// Whether the plan means the photo for a facade that the facet is a part of or spans.
bool IsPlannedFor(const Facet& facet, const SurveyPhoto& photo);

// For each of the photos what it costs more on the facet: nothing for planned ones, nor for any
// where none is planned.
std::vector<float> PriorCosts(const Facet& facet, std::span<const SurveyPhoto> photos,
                              std::span<const int> indices);

}  // namespace stucco
