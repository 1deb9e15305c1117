// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/flight/placing.h"
#include "simulate/flight/prepare.h"
#include "survey/plan.h"

namespace stucco::simulate {

// A flat field of 200 m, "G0", with one house of 12 x 8 x 6 m on it, "B0001", whose south-west
// corner is the origin; in closed form, without a renderer. The ground is at z = `ground_m`.
SceneShape MadeScene(double ground_m = 0);
SceneInfo MadeSceneInfo();  // at 50.1 degrees north, 14.2 east, z = 0 at 250 m

// Around the house: `views` photos, two at each stop, from 20 m to 12 m before its walls, 5 m and
// more above the ground; without terrain, its origin the scene's.
Plan MadePlan(int views);

// Sky above the horizon, a checkered ground below it: pictures that depend on the pose.
Photographer MadePhotographer();

}  // namespace stucco::simulate
