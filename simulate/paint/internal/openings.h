// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "simulate/paint/internal/wall_look.h"

namespace stucco::simulate::internal {

// A pane with what is behind it and what it mirrors.
void PaintGlass(Tile& tile, const WallLook& look, const WallPart& part, const Box& glass);
// A piece of a frame with lit and shaded edges, and a frame of four.
void PaintBar(Tile& tile, const Box& bar, Colour colour, uint32_t seed);
void PaintFrame(Tile& tile, const Box& box, float bar_m, Colour colour, uint32_t seed);

void PaintWindow(Tile& tile, const WallLook& look, const WallPart& part);
void PaintDoor(Tile& tile, const WallLook& look, const WallPart& part);
void PaintShopWindow(Tile& tile, const WallLook& look, const WallPart& part);
void PaintBalcony(Tile& tile, const WallLook& look, const WallPart& part);
void PaintCornice(Tile& tile, const WallLook& look, const WallPart& part);
void PaintLedge(Tile& tile, const WallLook& look, const WallPart& part);
void PaintPlinth(Tile& tile, const WallLook& look, const WallPart& part);

// Blocks at the wall's corners and bands at its floors, where the building has them.
void PaintOrnament(Tile& tile, const WallLook& look);

// Around an opening.
void PaintSurround(Tile& tile, const WallLook& look, const Box& box);
// Bricks on end over an opening, as a lintel is faced.
void PaintSoldierCourse(Tile& tile, const WallLook& look, const Box& box);
void PaintSill(Tile& tile, const WallLook& look, const Box& box);
void PaintShutter(Tile& tile, const WallLook& look, const Box& leaf);

// Words of a made-up language: a line of letters in `box`, one colour.
void PaintLetters(Tile& tile, const Box& box, Colour colour, uint32_t seed);

}  // namespace stucco::simulate::internal
