// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/grid_index.h"
#include "proxy/options.h"
#include "proxy/plane.h"
#include "proxy/samples.h"
#include "proxy/scale.h"

namespace stucco {

// Planes grown from the samples (DetectPlanes), merged, completed, without leaves and clutter.
// `index` is over the samples, `agreement` what SmoothNormals returned for them.
std::vector<Plane> FindPlanes(const Samples& samples, const GridIndex& index,
                              const std::vector<double>& agreement, const Tolerances& tolerances,
                              const ProxyOptions& options);

}  // namespace stucco
