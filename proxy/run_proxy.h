// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>

#include "proxy/options/proxy_options.h"
#include "survey/stage.h"

namespace stucco {

// `max_points`, or what half of the memory holds, but never under 100000.
int PointsWithin(uint64_t memory_limit_bytes, int max_points);

// dense/cloud.ply, calib/sparse/0, calib/georef.json and, where there is one, plan/plan.json ->
// facets.json, proxy.obj, proxy.city.json.
void RunProxy(const ProxyOptions& options, StageContext& context);

}  // namespace stucco
