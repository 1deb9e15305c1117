// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/grid_index.h"
#include "proxy/cloud/samples.h"
#include "proxy/planes/plane.h"

namespace stucco {

struct DetectOptions {
  double radius = 0;   // neighbours of a sample
  double epsilon = 0;  // largest distance from the plane
  double normal_angle_deg = 35;
  int min_points = 60;
};

// Planes by region growing from the samples whose neighbours agree best (Rabbani, van den Heuvel,
// Vosselman, "Segmentation of point clouds using smoothness constraint", 2006; CGAL
// Shape_detection), largest first. `agreement` is what SmoothNormals returned: samples whose
// neighbours look every way (leaves) begin no plane.
std::vector<Plane> DetectPlanes(const Samples& samples, const GridIndex& index,
                                const std::vector<double>& agreement, const DetectOptions& options);

}  // namespace stucco
