// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/camera/hover.h"

namespace stucco::plan {

// For a closed tour, how many facades have photos on both sides of a cut after each hover. The
// photos of a facade span the part of the tour that is left without the longest stretch that has
// none of them: a cut there divides nothing.
std::vector<int> FacadesDivided(std::span<const Hover> tour, size_t facades);

}  // namespace stucco::plan
