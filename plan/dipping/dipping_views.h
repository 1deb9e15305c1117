// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/hover.h"
#include "plan/dipping/level.h"
#include "survey/stage.h"

namespace stucco::plan {

struct DippingReport {
  std::vector<Hover> hovers;
  int candidates = 0;
  int points = 0;
  int rounds = 0;
  double optimise_s = 0;  // wall time of the optimisation
};

// Paper, section 4: views from between the buildings at every wall that can be seen from there.
DippingReport PlanDippingViews(const DippingSetting& setting, Progress& progress);

}  // namespace stucco::plan
