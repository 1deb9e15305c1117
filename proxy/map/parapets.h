// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/cloud/scale.h"
#include "proxy/map/outlines.h"
#include "proxy/planes/plane.h"

namespace stucco {

// Gutters and parapets, and how the cloud rounds them off, are no roofs of their own. `width`: how
// near to the outline of the building that is.
void DropRims(const Samples& samples, const MapBuilding& building, double width,
              std::vector<Plane>& planes);

// Takes out, of the planes above a footprint, what stereo makes of parapets and low walls on a
// roof:
//  - level planes less than 1.2 m above a roof, half of whose samples lie along the outline (within
//    twice the level of detail): what else lies at their height, where hardly anything is seen, are
//    strays. Planes that are as dense inside as the roof are platforms.
//  - strips up to 2.5 m wide that rise from a level roof by no more than a parapet does, and beyond
//    which no level roof goes on: stereo smears a parapet over the roof before it. Mansards fall
//    towards the end of the roof, and round what stands on a roof it goes on.
//  - strips up to 1.5 m wide, steeper than 53 degrees, that lead from a level roof up to another:
//    the smeared walls of what stands on it. Below mansards there is no roof.
//  - what is rougher than roofs are: thicker than an eighth of the level of detail (rms), while its
//    normals scatter by more than 10 degrees, and by 6 more than those of a roof twice its size, in
//    clouds as dense as details ask for. Those of heads of staircases scatter by 2 to 9 degrees, in
//    clouds of made towns from their photos, those of what is smeared around them by 9 to 20.
// Units are metres, z is up.
void DropParapets(const Samples& samples, const MapBuilding& building, const Tolerances& tolerances,
                  std::vector<Plane>& planes);

}  // namespace stucco
