// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "calib/scene/scene.h"

namespace stucco {

// Takes away points that lie behind what their photos show around them: of the twelve points that
// are next to one in a picture half and more are less than half as far, in at least half of its
// photos. Two photos of a wall whose windows look alike match one window with the next; where the
// row lies along the epipolar lines such matches have points, far behind the wall, and far points
// hold how photos are turned. What is seen past an edge, or through a gateway, has neighbours of
// its own. Returns how many points were taken. Photos are looked at side by side; any number of
// threads gives the same.
int DropHiddenPoints(int threads, Scene& scene);

}  // namespace stucco
