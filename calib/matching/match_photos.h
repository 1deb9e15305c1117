// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "calib/matching/detect_photos.h"
#include "calib/matching/photo_set.h"
#include "calib/matching/repeating_walls.h"
#include "calib/options/calib_options.h"
#include "calib/two_view/initial_pair.h"
#include "calib/two_view/verify.h"
#include "survey/stage.h"

namespace stucco {

// A pair of photos that was matched.
struct TriedPair {
  int first = 0;
  int second = 0;
  int num_matches = 0;   // before verification
  int num_verified = 0;  // of these; 0 where the pair was refused
};

struct MatchedPairs {
  std::vector<VerifiedPair> verified;
  std::vector<TriedPair> tried;
};

// Verified pairs among the photos, by their indices, checkpointed by the content of both. Where a
// plan chose the pairs and most of those do not match, the photos show something else: then others
// are tried too, with a warning. What shows a wall that repeats itself is left out.
MatchedPairs MatchAll(const CalibOptions& options, const PhotoSet& set,
                      const DetectedFeatures& features, const OnRepeatingWalls& repeating,
                      const StageContext& context);

// What verification knows of a pair of the photos.
VerifyOptions VerifyOptionsOf(const CalibOptions& options, const PhotoSet& set, int first,
                              int second);

}  // namespace stucco
