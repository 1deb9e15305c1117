// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "survey/captures.h"
#include "survey/plan.h"
#include "survey/proxy.h"
#include "texture/photo.h"

namespace stucco {

// What a photo costs more than ViewCost says, everywhere on a facet whose facade the plan means
// other photos for. On the scale of ViewCost, where no resolution at all costs 0.4 and half of the
// usual sharpness 0.1: between photos about as good as each other the planned ones win, which are
// alike and few by the plan's design; a planned photo that is visibly blurred, turned away,
// coarser by an eighth or blocked loses all the same, and one that is missing costs nothing.
inline constexpr float kUnplannedCost = 0.05f;

// Writes the facades that each photo is meant for. `captures` are by path.
void KnowPlan(const Plan& plan, const std::map<std::string, CapturedPhoto>& captures,
              std::span<TexturePhoto> photos);

// Whether the plan means the photo for a facade that the facet is a part of or spans.
bool IsPlannedFor(const Facet& facet, const TexturePhoto& photo);

// For each of the photos what it costs more on the facet: nothing for planned ones, nor for any
// where none is planned.
std::vector<float> PriorCosts(const Facet& facet, std::span<const TexturePhoto> photos,
                              std::span<const int> indices);

}  // namespace stucco
