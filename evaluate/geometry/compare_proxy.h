// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <string>

#include "evaluate/geometry/cloud.h"
#include "simulate/flight/flight_folder.h"
#include "survey/pose.h"
#include "survey/proxy.h"

namespace stucco::evaluate {

// What a proxy is measured against, all in the frame of the truth.
struct ProxyTruth {
  const Proxy& facets;    // the planar truth
  const Surface& relief;  // the same buildings and ground with all they have standing out
  const SceneIndex& scene;
  std::span<const simulate::FlownPhoto* const> photos;
  std::span<const std::string> planned_facades = {};  // ids of the plan's; empty: all are known
};

// The undersides of buildings, which nothing sees, count for validity alone. Validity is that of
// the coordinates as they are: in another frame they would be rounded.
ProxyFigures CompareProxy(const Proxy& result, const Similarity& truth_from_result,
                          const ProxyTruth& truth, double tolerance_m, int threads);

// Whether a building of a proxy is the ground.
bool IsGround(const Building& building);

// Walls, roofs and overhangs of all buildings.
Surface BuildingSurface(const Proxy& proxy);

}  // namespace stucco::evaluate
