// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/cloud/scale.h"
#include "proxy/map/extrude_cells.h"
#include "proxy/map/outline_fit.h"
#include "survey/proxy.h"

namespace stucco {

// The faces of a building's solid as facets, in the upright frame, without ids: classes, facades of
// the plan, and how much of each the samples show. `near` are the samples around the building.
std::vector<Facet> FacetsOf(const std::vector<ExtrudedFace>& faces, const FittedBuilding& building,
                            const Samples& near, const Tolerances& tolerances,
                            double normal_angle_deg);

// The same facets turned about the origin.
std::vector<Facet> Turned(std::vector<Facet> facets, const Eigen::Matrix3d& rotation);

}  // namespace stucco
