// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/map/fitted_building.h"

namespace stucco {

// How high the walls of a building are seen to go, metre by metre along its outline. Photos of a
// tower can show its walls to the top and nothing of its roof: what then looks upwards inside of
// the outline (floors of loggias, window sills, points behind panes) lies below the tops of the
// walls, and is none.
class WallTops {
 public:
  // `near`: samples on and around the building, in the upright frame; those within `reach` of an
  // edge that look out of it are of its wall.
  WallTops(const FittedBuilding& building, const Samples& near, double reach);

  // Whether a place inside of the outline lies farther below the top of the nearest wall that was
  // seen than any roof falls away from a wall.
  bool IsBelow(const Eigen::Vector3d& place) const;

  // The height at which most of the walls end that were seen; nothing: hardly any was.
  std::optional<double> Height() const;

 private:
  // A piece of an edge where the wall was seen.
  struct Piece {
    Segment2d line;
    double top = 0;
  };
  std::vector<Piece> pieces_;
};

}  // namespace stucco
