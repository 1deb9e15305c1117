// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/paint/internal/library.h"
#include "simulate/paint/internal/tile.h"
#include "simulate/paint/wall_design.h"

namespace stucco::simulate::internal {

// What the walls of one building have in common, drawn from its seed, and what this wall needs to
// be painted.
struct WallLook {
  const WallDesign* design = nullptr;
  const FacadePicture* picture = nullptr;
  Palette palette;        // the picture's, calmed
  uint32_t building = 0;  // seeds
  uint32_t wall = 0;
  float width_m = 0;
  float height_m = 0;
  Colour surround;  // around openings, cornices: painted plaster or stone; metal on glass walls
  Colour frame;     // of windows
  Colour shutter;   // and doors
  Colour coat;      // of paint, where the wall is repainted
  float soot = 0;   // 0 clean ... 1 never cleaned
  bool shutters = false;
  bool surrounds = false;
  int window_style = 0;
};

WallLook LookOf(const WallDesign& design);

inline Box BoxOf(const WallPart& part) {
  const Eigen::Vector4f corners = Eigen::Vector4d(part.top_left.x(), part.top_left.y(),
                                                  part.bottom_right.x(), part.bottom_right.y())
                                      .cast<float>();
  return {corners[0], corners[1], corners[2], corners[3]};
}

// A number in [0, 1) that belongs to the building, by a name of our choice.
inline float Trait(const WallLook& look, int which) {
  return Uniform(which, 77, look.building);
}

// The bare wall.
void PaintBrick(Tile& tile, const WallLook& look);
void PaintPlaster(Tile& tile, const WallLook& look);
void PaintStone(Tile& tile, const WallLook& look);
void PaintConcrete(Tile& tile, const WallLook& look);
void PaintPanels(Tile& tile, const WallLook& look);
void PaintCurtainWall(Tile& tile, const WallLook& look);

// Rain, dust and age on what is there.
void Weather(Tile& tile, const WallLook& look);

// What is on the wall.
void PaintPart(Tile& tile, const WallLook& look, const WallPart& part);
// Pipes, vents, lamps, cables, posters: where parts leave room.
void PaintFittings(Tile& tile, const WallLook& look);

// The sky and the houses opposite, as a pane mirrors them; x and y in metres on the wall.
Colour Mirrored(float x, float y, float horizon_y, uint32_t seed);

}  // namespace stucco::simulate::internal
