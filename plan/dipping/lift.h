// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "plan/camera/hover.h"
#include "plan/dipping/level.h"
#include "plan/dipping/wall_view.h"

namespace stucco::plan {

// The photos of one view's vertical sequence.
struct Dip {
  std::vector<double> z_m;           // of the level photos, from the top down
  double height_m = 0;               // of the wall in one photo
  std::optional<double> foot_pitch;  // of one more photo at the bottom, when the foot needs it
};

// Level photos one below the other, every k_d times the height of a photo or a little denser, from
// the wall's top to its foot as far as the lowest altitude allows. The paper starts at the safe
// altitude H for want of a better bound; here the first photo holds the top of the wall, or the
// highest that the wall can have (d_min below H), with half the overlap to spare, and the steps are
// equal. A turned photo shows more of a wall than one straight at it from as near: what counts is
// the distance along its axis (the paper, whose views are nearly frontal, takes that from the
// wall's line). A foot that the last one does not show gets a photo tilted down at the same place.
Dip MakeDip(const Level& level, const DippingSetting& setting, const Eigen::Vector2d& p,
            const WallView& view);

// Paper, section 4.3: the number of hovers of the sequences that start from one point, less what
// merging photos at nearly the same height saves: delta(d) for both orders of a pair. The paper
// sums over all pairs, which saves more hovers than there are as soon as three sequences meet; here
// a photo is merged with one other at most, the nearest above. For two sequences it is the same.
double HoveringCost(std::span<const Dip> dips, double vertical_step);

// The hovers of a point: photos of different sequences that are nearer to each other than their
// overlap are taken from their middle. Of photos that look nearly the same way from one stop, as at
// walls in one line, one is taken where it holds what all are meant for.
std::vector<Hover> Lift(const Level& level, const DippingSetting& setting,
                        const DippingPoint& point);

}  // namespace stucco::plan
