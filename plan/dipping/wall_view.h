// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "plan/dipping/level.h"
#include "plan/quality/facade_quality.h"
#include "plan/site.h"
#include "survey/intervals.h"

namespace stucco::plan {

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

// The stretch of the facade's line that p sees at no more than kMaxIncidence.
Interval FrontalWindow(const Facade& facade, const Eigen::Vector2d& p);
// The stretch of the facade's line that lies in the field of view of a camera at p; `turn_rad` as
// in WallView.
Interval FieldWindow(const Facade& facade, const Eigen::Vector2d& p, double turn_rad,
                     double hfov_rad);
// The turn that aims from p at a point of the facade, `along_m` from a.
double TurnTowards(const Facade& facade, const Eigen::Vector2d& p, double along_m);

// `visible` as SeenFrom gives it, cut to the field of view, rounded as there.
Intervals InField(std::span<const Interval> visible, const Interval& window);

SeenPart PartOf(const Facade& facade, const Eigen::Vector2d& p, const WallView& view);
// Eq. 2 for a view from p.
double ScoreOf(const DippingSetting& setting, const Eigen::Vector2d& p, const WallView& view);

}  // namespace stucco::plan
