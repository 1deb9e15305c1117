// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "survey/plan.h"

namespace stucco::plan {

// The whole plan for people and globes: a folder per flight with its path and photos, facades as
// walls coloured by their predicted quality, buildings, no-fly polygons. Heights are above the
// ground where the plan knows no terrain, else absolute.
std::string PlanKml(const Plan& plan);

// The same for geographic information systems: GeoJSON (RFC 7946, WGS 84), where the property
// "layer" is view, hover, path, facade, footprint, no_fly or home.
std::string PlanGeoJson(const Plan& plan);

}  // namespace stucco::plan
