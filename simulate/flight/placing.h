// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "simulate/render/pictures.h"
#include "simulate/scene/scene_folder.h"
#include "survey/captures.h"
#include "survey/georef.h"
#include "survey/plan.h"
#include "survey/pose.h"

namespace stucco::simulate {

// Renderer::Cast, or what stands for it in a test.
using CastRay = std::function<std::optional<RayHit>(const Eigen::Vector3d& from,
                                                    const Eigen::Vector3d& direction)>;

// What is known about a scene without drawing it.
struct SceneShape {
  Eigen::AlignedBox3d box;
  std::vector<std::string> elements;
  bool is_ours = false;  // made by MakeCity: the names of its elements say what they are
  CastRay cast;
};

// Where a plan lies in the frame of a scene.
struct PlacedPlan {
  PlanOrigin origin;
  double height_m = 0;   // of the plan's z = 0, in the heights of `world`
  Georef world;          // frame "enu": the scene's
  int walls_judged = 0;  // of how many walls it can be said whether they stand in the scene
};

// A scene that does not say where it lies is taken to be in the frame of the plan. The plan's z = 0
// is origin.height_m; where that is 0 (a plan without terrain) it is the median of the scene's
// ground before the plan's walls, or its ground at the plan's origin or home. Throws Error
// (kBadInput) when the plan's footprints are not where the scene is, or fewer than half of its
// walls stand there.
PlacedPlan PlacePlan(const Plan& plan, const SceneInfo& info, const SceneShape& scene);

Eigen::Vector3d WorldFromPlan(const PlacedPlan& placed, const Eigen::Vector3d& position_m);
// Columns: east, north and up of the plan at a place, in the world; they turn away from the world's
// axes by the earth's curvature.
Eigen::Matrix3d PlanAxesAt(const PlacedPlan& placed, const Eigen::Vector3d& position_m);

// A camera with its horizon turned by roll about the viewing direction (docs/conventions.md).
Pose CameraPose(const PlacedPlan& placed, const Eigen::Vector3d& position_m,
                const GimbalAngles& angles);

// Why no drone can be at a place: "stands inside B0001/R0", "is below the ground"; nothing when it
// can.
std::optional<std::string> WhyBlocked(const SceneShape& scene, const Eigen::Vector3d& place);

// The tree in whose crown a place is, or whose leaves the rotors of a drone there would touch, of
// which no map knows: nothing where there is none.
std::optional<std::string> TreeInTheWay(const SceneShape& scene, const Eigen::Vector3d& place);

}  // namespace stucco::simulate
