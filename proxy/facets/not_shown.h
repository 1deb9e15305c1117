// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <string>
#include <vector>

#include "proxy/scene/scene.h"
#include "survey/proxy.h"

namespace stucco {

// A part of a plane of the cloud that lies on no facet of the model.
struct NotShown {
  std::string building;  // the nearest one
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double area = 0;
  PlaneRole role = PlaneRole::kFree;
};

// What photos show of buildings and the model does not, the largest first: pieces of `planes` at
// least four times as large as the smallest facet, as wide as that everywhere, and no leaves, with
// a building within six levels of detail. What is level and no more than that above the foot of its
// building is ground. On a facet is what lies within two levels of detail of
// one that looks much the same way: windows in their wall, and bricks of a chimney, count as shown.
std::vector<NotShown> FindNotShown(const PlanarScene& scene, std::span<const Plane> planes,
                                   std::span<const Building> buildings, int threads);

}  // namespace stucco
