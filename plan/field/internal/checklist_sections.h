// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "plan/field/field_facts.h"
#include "survey/plan.h"

namespace stucco::plan::internal {

// Each one <section>.
std::string FlightsSection(const Plan& plan, const FieldFacts& facts);
std::string CameraSection(const Plan& plan);
std::string SunSection(const Plan& plan, const FieldFacts& facts);
std::string GroundPointsSection(const Plan& plan, const FieldFacts& facts);
std::string OnSiteSection(const Plan& plan, const FieldFacts& facts);

// A pixel on a wall at this distance, metres; 0 for a camera that is not known.
double PixelAt(const PlannedCamera& camera, double distance_m);

}  // namespace stucco::plan::internal
