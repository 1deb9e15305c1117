// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cmath>
#include <cstdint>
#include <span>
#include <vector>

#include "texture/photos/resample.h"

namespace stucco {

// One photo rectified on a rectangle of a facet's alignment raster.
struct GreyPicture {
  int width = 0;
  int height = 0;
  std::vector<uint8_t> grey;
  std::vector<uint8_t> valid;  // the photo shows the facet here, not an occluder
  int x = 0;                   // of the first texel on the raster
  int y = 0;
};

// The brightness of a colour (ITU-R BT.601), rounded.
template <typename T>
uint8_t GreyOf(const T* rgb) {
  return static_cast<uint8_t>(std::lround(0.299f * rgb[0] + 0.587f * rgb[1] + 0.114f * rgb[2]));
}

// A rectangle of the raster, texels.
struct GridArea {
  Eigen::Vector2d low = Eigen::Vector2d::Zero();
  Eigen::Vector2d high = Eigen::Vector2d::Zero();
};

// The same detail of the wall in two pictures, in raster texels.
struct GridMatch {
  int a = -1;  // indices of the pictures
  int b = -1;
  Eigen::Vector2d in_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d in_b = Eigen::Vector2d::Zero();
};

// Matches corners spread over the overlap of two pictures by normalised cross-correlation within
// `reach` texels, both ways, to a fraction of a texel. Rectified pictures of one plane differ by a
// small shift only, so that no descriptor is needed.
std::vector<GridMatch> MatchPictures(std::span<const GreyPicture> pictures, int a, int b,
                                     int reach);

struct Alignment {
  std::vector<GridShift> shifts;  // one per picture, in raster texels; identity when unsure
  double before_px = -1;          // median distance of matched details, raster texels
  // The same of each half of the matches after the shifts that the other half asks for; -1: nothing
  // could be matched.
  double after_px = -1;
};

// One smooth shift per picture that brings matched details together, all pictures at once: least
// squares with a prior on identity (so that no picture is the reference and errors of poses and
// proxy are shared), reweighted by Geman-McClure's function; with eight terms (homography), or six
// (affine), or two. A shift that would move a corner of what its picture shows (`areas`) by more
// than `limit_px` is not believed: that picture is left out and the others are solved anew, then it
// is fitted to them with fewer terms if that keeps to the limit. When most would be left out, or
// matches that had no say in the shifts lie no nearer by them, all get fewer terms instead. Pairs
// with fewer than eight matches do not count.
Alignment SolveAlignment(std::span<const GridMatch> matches, std::span<const GridArea> areas,
                         const Eigen::Vector2d& raster_size, double limit_px);

// MatchPictures over all pairs, then SolveAlignment.
Alignment AlignPictures(std::span<const GreyPicture> pictures, const Eigen::Vector2d& raster_size,
                        double limit_px);

}  // namespace stucco
