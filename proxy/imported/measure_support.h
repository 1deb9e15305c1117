// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "proxy/cloud/samples.h"
#include "survey/proxy.h"

namespace stucco {

// Which points of a cloud lie within `reach` of each facet: their number, their distances, and the
// share of its area that has some (cells of a hundredth of its side, not below `cell`). Of very
// many points every n-th.
void MeasureSupport(const PointStream& cloud, double reach, double cell, Proxy& proxy);

}  // namespace stucco
