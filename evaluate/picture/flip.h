// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// A screen of 0.7 m width with 3840 pixels seen from 0.7 m, as in the paper.
inline constexpr double kPixelsPerDegree = 67;

// Errors that a person sees who flips between the two pictures, by pixel: 0 none, 1 the largest.
struct FlipMap {
  int width_px = 0;
  int height_px = 0;
  std::vector<float> error;  // NaN where a filter would reach pixels outside the mask
};

// FLIP for pictures of low dynamic range (Andersson, Nilsson, Akenine-Möller, Oskarsson, Åström,
// Fairchild: "FLIP: A Difference Evaluator for Alternating Images", 2020): contrast sensitivity in
// an opponent space, HyAB distance of Hunt-adjusted CIELAB, edges and points. Pictures go on beyond
// their border as they end there.
FlipMap Flip(const PicturePair& pair, double pixels_per_degree = kPixelsPerDegree);

// Of the measured pixels; kNotMeasured where there is none.
double MeanError(const FlipMap& map);

// The map as people look at it: black is no error, bright yellow the largest (colours "magma"),
// grey where nothing was measured.
Image Coloured(const FlipMap& map);

}  // namespace stucco::evaluate
