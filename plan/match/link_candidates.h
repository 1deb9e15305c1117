// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/match/photo_graph.h"
#include "plan/space/obstacles.h"

namespace stucco::plan {

// What a photo looks at: the middle of what it shows, and from where it does.
struct Gaze {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  Eigen::Vector3d way = Eigen::Vector3d::UnitZ();  // unit, from there to the camera
  double distance_m = 0;
};

// Of the walls that it shows or, where `walls_only` is false, of everything. Nothing seen gives
// distance 0.
Gaze GazeOf(const SurfaceView& view, std::span<const Sight> sights, bool walls_only);

// Where a link photo costs what.
enum class LinkPlace {
  kHover,   // a hover that exists: the photo alone
  kColumn,  // above or below one: the drone passes there
  kOwn,     // a stop of its own
};

// What a link photo costs, in photos, with the stop that it takes there.
double LinkCost(LinkPlace place);

// A link photo in this direction, as far as gimbals tilt.
Shot LinkShot(const Eigen::Vector3d& way);

struct LinkCandidate {
  Eigen::Vector3d position = Eigen::Vector3d::Zero();
  Shot shot;
  LinkPlace place = LinkPlace::kOwn;
  int hover = -1;  // of kHover and kColumn
};

// Photos that look at the same middle from between that photo and what others see from above, all
// of them free: from the hovers that are near in direction and scale, from the column above the
// photo's own hover, and from places around.
std::vector<LinkCandidate> LinkCandidates(const Gaze& gaze, const Obstacles& obstacles,
                                          std::span<const Hover> hovers, int own_hover);

}  // namespace stucco::plan
