// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

// Why facets are not the boundary of a solid (open, not 2-manifold, not oriented outwards, crossing
// itself), or nothing. Corners are shared when their coordinates are equal; every facet must have
// its neighbours' corners among its own.
std::optional<std::string> FindOpening(const std::vector<Facet>& facets);

}  // namespace stucco
