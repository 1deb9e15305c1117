// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "proxy/cloud/input.h"
#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/options/findings.h"
#include "proxy/options/proxy_options.h"
#include "proxy/planes/plane.h"

namespace stucco {

// The cloud understood: samples, up, and the regularised planes told apart.
struct PlanarScene {
  Samples samples;
  Tolerances tolerances;
  Eigen::Vector3d up = Eigen::Vector3d::UnitZ();
  Eigen::Vector3d main_direction = Eigen::Vector3d::UnitX();
  std::vector<Plane> ground;                  // the main one first
  std::vector<std::vector<Plane>> buildings;  // largest first
  std::vector<int> support;                   // samples on any plane, ascending
  double leaf_scatter_deg = 0;                // LeafScatterDeg
};

// Whether a plane is laid through leaves: its normals scatter by more than leaf_scatter_deg.
bool IsOfLeaves(const PlanarScene& scene, const Plane& plane);

// Steps 1 to 5 of the README: samples, planes, up, regularisation, ground and buildings. Throws
// Error (kStageFailed) when there are too few points or no planes.
PlanarScene UnderstandCloud(const ProxyInput& input, const ProxyOptions& options, int threads,
                            ProxyFindings& findings);

}  // namespace stucco
