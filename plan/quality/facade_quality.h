// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>

#include "survey/plan.h"

namespace stucco::plan {

// The part of a facade that one view sees, as far as quality goes. m is the facade's inverse
// normal, into the wall.
struct SeenPart {
  double share = 0;       // of the facade that this view sees, in [0, 1]
  double frontality = 0;  // s . m of the viewing direction s
  Eigen::Vector3d direction = Eigen::Vector3d::Zero();  // s, unit
  double distance_m = 0;
};

// 1 at d_min and nearer, 0 at d_max and farther, linear between. Requires d_min < d_max.
double Closeness(double distance_m, double d_min, double d_max);

// Eq. 1 of the paper with the terms of docs/planning.md: how well these views together would paint
// the facade. `union_share` is the share of the facade that at least one of them sees. All terms
// are 0 without a view.
FacadeQuality QualityOfFacade(std::span<const SeenPart> parts, double union_share, double d_min,
                              double d_max);

// The terms of eq. 2 for a single view. `widest_share` is the share of the facade that a frontal
// view at this distance could see at most. Requires that it is above 0.
FacadeQuality QualityOfView(const SeenPart& part, double widest_share, double d_min, double d_max);

// Eq. 2: the terms of one view weighted as in the paper.
double ViewScore(const FacadeQuality& view);

}  // namespace stucco::plan
