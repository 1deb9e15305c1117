// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/planes/plane.h"

namespace stucco {

struct RegulariseOptions {
  double vertical_tolerance_deg = 8;
  double align_tolerance_deg = 6;
};

// Sets the planes' roles: those near vertical are walls and stand upright, those near horizontal
// are level, else they slope. Planes within the tolerance of vertical, and those that lean outwards
// a little, are walls in any case, but keep their lean where standing upright would move their
// points by more than level_of_detail.
void AssignRoles(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
                 const RegulariseOptions& options, std::vector<Plane>& planes);

// The horizontal direction that most of the area of these planes' walls looks along or across.
Eigen::Vector3d MainDirection(const Eigen::Vector3d& up, std::span<const Plane* const> planes);

// Of what was built together: sets roles, makes walls and roof directions near parallel or
// perpendicular so, equal pitches equal, and puts parallel planes nearer than level_of_detail into
// one (after Verdie, Lafarge, Alliez, "LOD generation for urban scenes", 2015, section 4). A
// direction is only turned as far as its points move by at most level_of_detail. Points that end up
// farther than level_of_detail from their plane leave it.
void Regularise(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
                const RegulariseOptions& options, std::vector<Plane>& planes);

}  // namespace stucco
