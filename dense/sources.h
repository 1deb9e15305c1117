// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <map>
#include <vector>

#include "dense/patch_match.h"
#include "survey/reconstruction.h"

namespace stucco {

// What the sparse points tell about one photo.
struct SourceChoice {
  std::vector<PhotoId> sources;     // each adds most to those before it
  std::vector<PhotoId> neighbours;  // the same order, further down: what may show the same
  float min_depth = 0;
  float max_depth = 0;
  std::vector<DepthSeed> seeds;  // pixels of the undistorted photo
};

struct SourceLimits {
  int sources = 0;
  int neighbours = 0;
  int max_image_px = 0;  // of the seeds' photos
};

// For every posed photo the photos to match it with: a point seen by both counts by the angle
// between its rays (best at 5 to 30 degrees, nothing below 1) and by how alike the photos' scales
// are (after Goesele et al. 2007); one that is only in the other's picture, half of that. Of
// photos that share enough points each next one is that which adds most to the parts of the
// picture that those before show badly: a roof near below may have few of the points, and none that
// the photos with the most have. Depth bounds are those of the photo's points, parts of the picture
// counting alike, with a margin. Photos without a usable neighbour have no entry.
std::map<PhotoId, SourceChoice> ChooseSources(const Reconstruction& reconstruction,
                                              const SourceLimits& limits);

}  // namespace stucco
