// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <utility>

namespace stucco {

inline constexpr double kMapReach_m = 1.5;      // eaves that a map traces, and then some
inline constexpr double kMapSigma_m = 0.5;      // of a map's edges, and of its buildings
inline constexpr double kMapTurn_rad = 0.0087;  // of its buildings: half a degree

// A near-vertical point beside an edge of a map.
struct WallHit {
  double distance = 0;       // outwards of the edge, metres, within kMapReach_m
  std::pair<int, int> cell;  // half metres along and up
  double along = 0;          // from the middle of the edge, metres
};

// Where the other walls of a map put this one, outwards of its edge in metres.
struct ExpectedWall {
  double distance = 0;
  double sigma = kMapSigma_m;  // of most walls; some are as far off as maps are
};

// How likely a wall is that far outwards of its edge, but for a factor.
double LikelihoodOf(double distance, const ExpectedWall& expected);

// Where the wall of an edge is, outwards of it in metres: where most of `hits` (by distance) lie in
// a strip as wide as the level of detail, weighted by how likely the wall is that far from where it
// is expected, or several times as much of it behind that, as behind the fronts of balconies; of
// those in a strip of kFlat_m, weighted alike; and of those, where there are
// enough, where they peak: a wall is flat, but for its windows, which stand a hand behind it, and a
// mean lies between the two. Of two peaks so far apart the outer one is the wall, as long as it has
// a quarter of the other's hits. Nothing where what lies there is too little for a wall of this
// length.
std::optional<double> WallAmong(std::span<const WallHit> hits, double level_of_detail,
                                const ExpectedWall& expected, double length);

}  // namespace stucco
