// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/city/house_mesh.h"
#include "simulate/city/town.h"
#include "simulate/scene/scene_folder.h"

namespace stucco::simulate {

// What happens to a town until its `day`-th day: one facade, at least 4 m wide and not of glass, is
// painted in a colour of another hue; one car has left, and one has come, a place before or behind
// another. Every later day differs from the first by changes of its own; on the first nothing has
// changed. Nothing happens that the town has no facade, car or room for. Requires day >= 1.
DayChanges LiveUntil(int day, const FacadeIds& facades, Town& town);

}  // namespace stucco::simulate
