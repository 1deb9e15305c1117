// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "site/visibility.h"

namespace stucco::plan {

// A point where the drone may dip, and what it sees from there in all directions.
struct Candidate {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::vector<SeenFacade> seen;
};

}  // namespace stucco::plan
