// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "evaluate/figures/evaluation.h"
#include "evaluate/picture/compare_textures.h"
#include "survey/proxy.h"
#include "survey/texture_set.h"

namespace stucco::evaluate {

// A wall of the truth and the facet of the result on it that has a picture.
struct PaintedWall {
  const Facet& truth;
  const Facet& result;
  const TexturedFacet& texture;
  const std::vector<bool>& not_of_building;  // elements of the scene: occluders and other buildings
};

// What the photos that painted a wall really show there, by labels, true poses and the true scene,
// on a grid of a decimetre: the area that some photo of the survey shows with nothing before it,
// and that part of it whose painter shows something else than the building. What relief of the wall
// itself hides does not count. Nothing is measured without labels. Throws Error (kBadInput) where
// pictures cannot be read.
OccludedArea PaintedThrough(const TextureComparison& comparison, const PaintedWall& wall);

}  // namespace stucco::evaluate
