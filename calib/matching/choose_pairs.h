// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <functional>
#include <optional>
#include <utility>
#include <vector>

#include "calib/features/features.h"
#include "calib/matching/photo_set.h"
#include "calib/options/calib_options.h"

namespace stucco {

// Pairs (a, b), a < b, ascending.
using PhotoPairs = std::vector<std::pair<int, int>>;

// What to match with what.
struct PairChoice {
  PhotoPairs pairs;
  bool by_plan = false;
  PhotoPairs otherwise;  // too, when the photos do not show what the plan says
};

// Where the photos were recorded, metres in a frame about the first of them.
std::vector<std::optional<Eigen::Vector3d>> RoughPositions(
    const std::vector<const CapturedPhoto*>& photos);

// Appearance of each of `count` photos (see Signature in pairs.h), in words of their own.
std::vector<std::vector<float>> Signatures(int count,
                                           const std::function<Features(int)>& features_of,
                                           int threads);

// All pairs of a small set. Else by the plan, where there is one: those that should overlap, the
// most similar in appearance, and those near in position of photos of which the plan says little.
// Without a plan by nearness and appearance (see SelectPairs). `features_of` gives a photo's
// features with their descriptors, on several threads.
PairChoice ChoosePairs(const CalibOptions& options, const PhotoSet& set,
                       const std::function<Features(int)>& features_of, int threads);

}  // namespace stucco
