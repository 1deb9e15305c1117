// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// Registered photos that were taken at one hover.
struct SamePlace {
  int first = 0;
  int second = 0;
  double sigma_m = 0;  // of the difference of their centres, per axis, as it counts
};

// All pairs of each hover, in order. n photos about one unknown place say of the n (n - 1) / 2
// differences together as much as if each were good to the root of n times the deviation of one
// photo: the place, eliminated from the normal equations, leaves (I - 1 1' / n) / sigma^2. Nothing
// where Scene::hover_sigma_m is not known.
std::vector<SamePlace> SamePlaces(const Scene& scene);

// By photo: the registered others of its hover, ascending.
std::vector<std::vector<int>> HoverMates(const Scene& scene);

}  // namespace stucco
