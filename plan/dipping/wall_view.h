// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plan/dipping/setting.h"
#include "plan/quality/facade_quality.h"
#include "site/site.h"
#include "survey/intervals.h"

namespace stucco::plan {

// Of the width of a photo, what neighbours on a wall share at least (docs/planning.md).
inline constexpr double kOverlap = 0.22;

// A level view at one facade, on the map. Its direction is the facade's inverse normal turned by
// `turn_rad` towards b.
struct WallView {
  int facade = 0;
  double turn_rad = 0;
  // It does not follow the facade's common direction, because what it is for cannot be seen so.
  bool own_turn = false;
  Intervals seen;
};

// A point from which the drone dips, with what it captures there.
struct DippingPoint {
  Eigen::Vector2d position = Eigen::Vector2d::Zero();
  std::vector<WallView> views;
};

// Of p, from the line of the facade; positive outside.
double DistanceTo(const Facade& facade, const Eigen::Vector2d& p);
Eigen::Vector2d Direction(const Facade& facade, double turn_rad);

// The stretch of the facade's line that p sees at no more than kMaxIncidence_rad.
Interval FrontalWindow(const Facade& facade, const Eigen::Vector2d& p);
// The stretch of the facade's line that lies in the field of view of a camera at p; `turn_rad` as
// in WallView.
Interval FieldWindow(const Facade& facade, const Eigen::Vector2d& p, double turn_rad,
                     double hfov_rad);
// How far the nearest of what a view shows lies along its axis, in metres: the picture is the
// smallest there.
double LeastDepth(const Facade& facade, const Eigen::Vector2d& p, const WallView& view);
// The turn that aims from p at a point of the facade, `along_m` from a.
double TurnTowards(const Facade& facade, const Eigen::Vector2d& p, double along_m);

// What a photo from p captures of `visible` (as SeenFrom gives it, and rounded as there). Where the
// photo ends before the visible part does, half of kOverlap of its width is left to the neighbour.
Intervals InPhoto(const DippingSetting& setting, const Facade& facade, const Eigen::Vector2d& p,
                  double turn_rad, std::span<const Interval> visible);

SeenPart PartOf(const Facade& facade, const Eigen::Vector2d& p, const WallView& view);
// Eq. 2 for a view from p.
double ScoreOf(const DippingSetting& setting, const Eigen::Vector2d& p, const WallView& view);

}  // namespace stucco::plan
