// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/stage.h"
#include "texture/options/texture_options.h"

namespace stucco {

// Paints every facet of proxy/facets.json with the few photos that show it best and writes
// textures/, labels/, orthophotos/, model.glb, model.obj with model.mtl, and textures.json below
// `context.out`. Throws Error (kBadInput) when an input is missing or damaged, (kStageFailed) when
// no photo sees any facet.
void RunTexture(const TextureOptions& options, StageContext& context);

}  // namespace stucco
