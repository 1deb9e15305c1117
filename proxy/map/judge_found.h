// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <string>

#include "proxy/map/close_building.h"
#include "proxy/map/upright_survey.h"
#include "proxy/scene/scene.h"

namespace stucco {

// Why a house that was closed on a footprint found in the cloud is better built of its planes
// alone; empty where it is not. Its walls have to be found along half of its outline, where the
// survey shows walls (of a front alone nobody knows the rest); they may not lean, as an extrusion
// cannot; and what is seen of it has to lie on it: where planes are seen well inside, it is a frame
// or a canopy, and hollow. `survey` is the scene, upright.
std::string WhyNotOnFootprint(const ClosedBuilding& closed, const PlanarScene& scene,
                              const UprightSurvey& survey);

}  // namespace stucco
