// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <optional>
#include <span>

#include "proxy/map/outlines.h"
#include "proxy/map/upright_survey.h"

namespace stucco {

// The ground of a building is looked for this far around it.
inline constexpr double kRing_m = 4;

// Height of the lowest ground next to a building; nothing where the cloud shows too little of it.
std::optional<double> GroundAround(const UprightSurvey& survey, const MapBuilding& building);

// Whether most of what the cloud shows at that height next to a building lies on its neighbours, or
// within a metre of them: where these enclose it, the lowest that anybody sees are their roofs.
bool LiesOnNeighbours(const UprightSurvey& survey, const MapBuilding& building, double height,
                      std::span<const MapBuilding* const> neighbours);

// The ground around a building as one plane: what rises above the lowest of it need not stand on
// it.
struct GroundSlope {
  Eigen::Vector2d rise = Eigen::Vector2d::Zero();  // per metre
  double height = 0;                               // at the origin

  double At(const Eigen::Vector2d& p) const { return height + rise.dot(p); }

  // Whether a sample, in the upright frame, is of that ground.
  bool Shows(const Eigen::Vector3d& p) const {
    constexpr double kThickness_m = 0.5;  // of ground that is no plane, with grass and noise
    return std::abs(p.z() - At(p.head<2>())) < kThickness_m;
  }
};

// By the lowest of what looks up next to it, by eighths of the way round: the plane on which most
// of these lie, and below which none does; of the others a neighbour or a hedge hides the ground.
// Nothing where the cloud shows the ground on less than five of the eight, or no such plane.
std::optional<GroundSlope> SlopeAround(const UprightSurvey& survey, const MapBuilding& building);

}  // namespace stucco
