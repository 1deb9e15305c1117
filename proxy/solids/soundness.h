// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "proxy/solids/solid.h"
#include "survey/proxy.h"

// One building's geometry must not cost the survey its model: what fails is left out, and says so.
namespace stucco {

// What forbids writing the facet (survey/proxy.h), or that nothing lies inside its rings.
std::optional<std::string> FindFacetFault(const Facet& facet);

// Runs `close`. A solid with an unsound facet, and whatever is thrown, become a solid without
// facets that says why.
Solid CloseOrExplain(const std::function<Solid()>& close);

// Runs `outline` and leaves out unsound facets, all of them when it throws; `warnings` gets a line
// for each.
std::vector<Facet> OutlineOrWarn(const std::function<std::vector<Facet>()>& outline,
                                 std::vector<std::string>& warnings);

}  // namespace stucco
