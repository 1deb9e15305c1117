// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

// The square of three normal variables that one in ten thousand exceeds (chi squared).
inline constexpr double kUnlikelySquare = 21.1;
// That one in a hundred exceeds, and that of six variables that one in ten thousand does.
inline constexpr double kDoubtfulSquare = 11.3;
inline constexpr double kUnlikelySixSquare = 27.9;

// Of the variance of neighbours' records: receivers drift, compasses depend on the place.
inline constexpr double kCommonShare = 0.5;

// Photos that are off their records together, ascending: each by no more than records are off, but
// all the same way, as a part that hangs on the rest by little is when it is bent. Groups are a
// photo and those that share most points with it; the mean of their differences in attitude and
// position is tested at a level of 1e-4, with half of a record's variance taken to be common to
// neighbours (receivers drift, compasses depend on the place). Where attitudes are off together,
// but turned as they say the photos would lie farther from their recorded positions by more than
// chance, it is the attitudes that are off. Of such a group those count that
// are off the mean's way by at least half of it. `agrees` are the photos whose poses agree with
// their records by themselves; others belong to no group. Requires poses in the frame of the
// priors.
std::vector<int> ContradictingGroups(const Scene& scene, const std::vector<bool>& agrees);

}  // namespace stucco
