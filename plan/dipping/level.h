// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "plan/camera/preset.h"
#include "plan/dipping/reach.h"
#include "plan/space/obstacles.h"
#include "site/site.h"
#include "site/visibility.h"

namespace stucco::plan {

// What the dipping views are planned with.
struct DippingSetting {
  const Site& site;
  const Obstacles& obstacles;
  double hfov_rad = 0;
  double width_per_m = 0;  // of the wall in a photo, per metre of distance
  double height_per_m = 0;
  double d_min_m = 0;
  double d_max_m = 0;
  double vertical_step = 0.8;  // k_d
  int threads = 1;
};
DippingSetting MakeSetting(const Site& site, const Obstacles& obstacles, const CameraPreset& camera,
                           double d_max_m);

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
