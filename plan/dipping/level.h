// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/dipping/reach.h"
#include "plan/dipping/setting.h"
#include "site/site.h"
#include "site/visibility.h"

namespace stucco::plan {

// The walls that begin at about the same height: those on the ground, or those above one or more
// roofs of lower parts of the same buildings. Each level is planned as a flat map of its own.
struct Level {
  double bottom_m = 0;  // z of the lowest foot of its walls
  bool on_ground = true;
  std::vector<int> facades;  // ascending
  Visibility visibility;     // all that reaches above the feet of its walls
  Reach reach = {};          // of the photos; no limit at first
};

// The levels of a site from below. Together they hold every facade once.
std::vector<Level> SplitIntoLevels(const Site& site);

// The lowest z at which a photo may be taken above p at this level.
double LowestAt(const Level& level, const DippingSetting& setting, const Eigen::Vector2d& p);

// Whether the drone may go up and down above p between there and the ceiling.
bool MayDip(const Level& level, const DippingSetting& setting, const Eigen::Vector2d& p);

// The facades of the level in sight of p with the parts that are near and frontal enough (d_max,
// the largest incidence, and the level's reach). Ends are rounded inwards to whole centimetres, so
// that the same corner seen from two points gives the same number; pieces below 5 cm are left out.
std::vector<SeenFacade> SeenFrom(const Level& level, const DippingSetting& setting,
                                 const Eigen::Vector2d& p);

}  // namespace stucco::plan
