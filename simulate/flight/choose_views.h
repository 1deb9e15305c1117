// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/flight/options.h"
#include "survey/plan.h"

namespace stucco::simulate {

// The plan with the views alone that a flight by `options` takes (`facades`, `most_photos`): those
// that are meant for one of the facades, or show its middle from within 60 degrees and d_max; of
// too many, as many for each facade, spread over its views in the order of the flight. Throws Error
// (kUsage): a facade that the plan does not have, or has no view of.
Plan ChooseViews(Plan plan, const FlightOptions& options);

}  // namespace stucco::simulate
