// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "calib/features/features.h"

namespace stucco {

struct PairOptions {
  int exhaustive_below = 150;  // photos
  int neighbours = 40;         // candidates per photo above that
  int followers = 5;           // and as many that come next in the order of names
  int threads = 1;
};

// Pairs (a, b), a < b, ascending, that are worth matching: all of a small set; else each photo's
// nearest by position where both have one, the most similar by appearance, and those that follow
// it. Positions and signatures are by photo.
std::vector<std::pair<int, int>> SelectPairs(
    const PairOptions& options, const std::vector<std::optional<Eigen::Vector3d>>& positions,
    const std::vector<std::vector<float>>& signatures);

// Pairs (a, b), a < b, ascending: each photo with the `count` others of the most similar
// appearance.
std::vector<std::pair<int, int>> MostAlike(const std::vector<std::vector<float>>& signatures,
                                           int count, int threads);

// At most `count` descriptors, spread evenly, as rows of 128 (UnitDescriptors in descriptors.h).
std::vector<int16_t> SampleDescriptors(const Features& features, size_t count);

// Appearance of a photo as one vector: VLAD (Jegou et al. 2010) with intra-normalisation over
// `words` (rows of 128), from at most 1000 of its descriptors.
std::vector<float> Signature(const Features& features, const std::vector<float>& words);

// Vocabulary of `count` words from samples of all photos' descriptors by Lloyd's algorithm with an
// evenly spaced start. `samples` are rows as UnitDescriptors gives them (descriptors.h).
std::vector<float> TrainVocabulary(const std::vector<int16_t>& samples, int count, int threads = 1);

}  // namespace stucco
