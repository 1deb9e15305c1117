// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>
#include <vector>

#include "simulate/flight/flight_folder.h"
#include "simulate/scene/scene.h"
#include "survey/georef.h"
#include "survey/proxy.h"
#include "survey/reconstruction.h"

namespace stucco::evaluate {

// A planar facet from its outer ring, counter-clockwise seen from outside; its facade id is its id.
Facet MadeFacet(const std::string& id, FacetClass facet_class,
                const std::vector<Eigen::Vector3d>& outer);

// A closed box: walls F00 (south), F01 (east), F02 (north), F03 (west), R0 and G0.
Building MadeBox(const std::string& id, const Eigen::Vector3d& low, const Eigen::Vector3d& high);

// Two houses of 10 x 8 x 6 m and 8 x 8 x 9 m with an alley of 12 m between them, on the ground
// z = 0 that reaches 15 m around them and is cut out below them.
Proxy MadeTruth();

// The truth as a model, an element per facet by its id, with a tree ("occluder/tree-000", a box of
// 2 x 2 x 4 m) that stands before B0001's south wall.
simulate::Scene MadeScene(const Proxy& truth);

// Twelve photos in a ring 60 m up and 60 m around the houses, looking at them, and one straight
// down. All of the houses and of the ground is in some photo.
simulate::Flight MadeFlight();

// The delivered photos of a flight as calibration would find them without any error.
Reconstruction MadeReconstruction(const simulate::Flight& flight);

// Where the made world lies.
Georef MadeGeoref();

// A similarity with nothing simple about it.
Similarity AnySimilarity();

}  // namespace stucco::evaluate
