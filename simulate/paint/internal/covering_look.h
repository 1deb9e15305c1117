// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/paint/internal/library.h"
#include "simulate/paint/internal/tile.h"
#include "simulate/paint/wall_design.h"

namespace stucco::simulate::internal {

struct CoveringLook {
  const CoveringDesign* design = nullptr;
  uint32_t whole = 0;  // seed of what all faces of a roof have in common
  uint32_t seed = 0;
};

inline float Trait(const CoveringLook& look, int which) {
  return Uniform(which, 78, look.whole);
}

// Of single texels; it averages out where they are larger than a centimetre.
inline float Grain(const Tile& tile, int column, int row, uint32_t seed) {
  return Normal(tile.x0 + column, tile.y0 + row, seed) * std::min(1.0f, 0.01f / tile.texel_m);
}

void PaintTiles(Tile& tile, const CoveringLook& look);
void PaintMembrane(Tile& tile, const CoveringLook& look);
void PaintGravel(Tile& tile, const CoveringLook& look);
void PaintMetal(Tile& tile, const CoveringLook& look);

void PaintAsphalt(Tile& tile, const CoveringLook& look);
void PaintPaving(Tile& tile, const CoveringLook& look);
void PaintGrass(Tile& tile, const CoveringLook& look);
void PaintCrop(Tile& tile, const CoveringLook& look);
void PaintSoil(Tile& tile, const CoveringLook& look);

}  // namespace stucco::simulate::internal
