// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstddef>
#include <functional>
#include <span>

#include "proxy/cloud/samples.h"
#include "survey/proxy.h"

namespace stucco {

// Visits points of the cloud with each facet, by number, that has one within `reach` of the box
// around its outline. Of more than `most_points` every n-th.
void ForEachPointNear(const PointStream& cloud, std::span<const Facet* const> facets, double reach,
                      size_t most_points,
                      const std::function<void(size_t facet, const CloudPoint& point)>& visit);

}  // namespace stucco
