// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Geometry>

#include "plan/site.h"

namespace stucco::plan {

double SignedArea(const Ring& ring);  // positive when counter-clockwise
double Area(const Polygon& polygon);
Eigen::AlignedBox2d BoundsOf(const Polygon& polygon);
// By crossings: points on the boundary may count either way.
bool Contains(const Polygon& polygon, const Eigen::Vector2d& p);
double DistanceToSegment(const Eigen::Vector2d& p, const Eigen::Vector2d& a,
                         const Eigen::Vector2d& b);
// 0 inside.
double Distance(const Polygon& polygon, const Eigen::Vector2d& p);

}  // namespace stucco::plan
