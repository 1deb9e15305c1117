// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/options/proxy_options.h"
#include "proxy/planes/plane.h"

namespace stucco {

// Planes grown from the samples (DetectPlanes), merged, completed, without leaves and clutter.
// `index` is over the samples, `agreement` what SmoothNormals returned for them.
std::vector<Plane> FindPlanes(const Samples& samples, const GridIndex& index,
                              const std::vector<double>& agreement, const Tolerances& tolerances,
                              const ProxyOptions& options);

}  // namespace stucco
