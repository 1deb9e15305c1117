// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "proxy/map/wall_among.h"

namespace stucco {

// How a wall is turned against the edge of a map.
struct WallTurn {
  double turn = 0;  // radians, counter-clockwise seen from above, within 2.3 degrees
  double span = 0;  // metres of the wall that tell: points at one end of it tell little
  double gain = 1;  // how much more lies in line at this turn than without one: a factor
};

// The turn at which most of `hits` lie in one line, those where the wall is expected before others;
// a small turn before a large one, as windows at one end of a wall and plaster at the other make a
// line, too. `length` is that of the edge, metres.
WallTurn TurnAmong(std::span<const WallHit> hits, const ExpectedWall& expected, double length);

// The same hits seen from the edge turned by so much about its middle, by distance.
std::vector<WallHit> Turned(std::span<const WallHit> hits, double turn);

}  // namespace stucco
