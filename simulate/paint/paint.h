// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/paint/wall_design.h"
#include "survey/image.h"

namespace stucco::simulate {

// Of a side of a picture: whole texels, the last of which may reach over the edge. Throws Error
// (kBadInput) where there are none or more than a JPEG can have.
int Texels(double side_m, double metres_per_texel);

// The albedo (sRGB) of a wall at `metres_per_texel`, the top-left corner of the top-left texel at
// the wall's top-left corner. Grain and joints down to a texel, nothing repeats. Colours and
// what panes show come from the facade pictures of the library.
Image PaintWall(const WallDesign& design, double metres_per_texel);
Image PaintCovering(const CoveringDesign& design, double metres_per_texel);

// For what is not on a wall's picture, reveals of windows and balcony slabs, a piece as large as
// `design` in the material of its wall.
Image PaintTrim(const WallDesign& design, double metres_per_texel);

// Leaves with alpha, for trees; and a parked car from the side, both ends and above (car_shape.h).
Image PaintLeaves(uint64_t seed, int side_px);
Image PaintCar(uint64_t seed, double metres_per_texel);

}  // namespace stucco::simulate
