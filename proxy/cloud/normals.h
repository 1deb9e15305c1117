// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/samples.h"

namespace stucco {

// Fills missing normals from the plane of the neighbours, towards the camera that sees the sample
// (without one: the mean camera; in a survey without photos: z), then averages each normal with
// those of neighbours within 45 degrees of it: noise falls, edges stay. Returns how well the
// neighbours agree, in [0, 1]: the order in which regions are grown from samples.
std::vector<double> SmoothNormals(Samples& samples, const GridIndex& index, double radius,
                                  int threads);

}  // namespace stucco
