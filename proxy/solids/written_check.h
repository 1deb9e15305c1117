// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "survey/proxy.h"

namespace stucco {

// Why facets do not bound a solid by the rules of val3dity (Ledoux, "val3dity: validation of 3D GIS
// primitives according to the international standards", 2018), or nothing: no ring passes a corner
// twice, corners lie within a centimetre of their facet's plane, and the surface is closed,
// 2-manifold, outward and does not cross itself (closed_check.h). Slivers that rounding turned away
// from their facet are let pass (its rule 204). Metres.
std::optional<std::string> FindFault(const std::vector<Facet>& facets);

// The same facets with corners rounded to multiples of `step` (metres, above 0). As in files,
// corners that fell together are one; facets that vanish are left out.
std::vector<Facet> Rounded(std::vector<Facet> facets, double step);

// The fault of a building as files have it, or nothing: its corners in whole millimetres as in
// CityJSON, and in single precision as in GLB, beside which OBJ with its 12 digits is exact.
// `upright`: facets in the frame whose z is up, in metres; GLB has them in the world.
std::optional<std::string> FindFaultAsWritten(const std::vector<Facet>& upright,
                                              const Eigen::Matrix3d& world_from_upright);

}  // namespace stucco
