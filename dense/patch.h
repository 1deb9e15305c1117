// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "dense/view.h"

namespace stucco {

// A window of 11 x 11 pixels sampled every second pixel, padded to whole vectors of eight.
inline constexpr int kPatchRadius = 5;
inline constexpr int kPatchSamples = 40;

// The reference side of a comparison, the same for every hypothesis at a pixel. Weights fall off
// with distance and grey difference (bilateral, as in Schoenberger et al. 2016), and sum to 1.
struct ReferencePatch {
  alignas(32) float weights[kPatchSamples];
  alignas(32) float weighted[kPatchSamples];  // weight * (value - mean)
  float variance = 0;
};

struct PixelPlace {
  float x = 0;
  float y = 0;
};

ReferencePatch MakeReferencePatch(const PackedImage& image, int x, int y);

// 1 - weighted normalised cross-correlation between the reference patch around `at` and where the
// homography takes it in `source`: 0 for a perfect match, kNoMatch when the patch leaves the image
// or either side has no texture. `homography` maps reference to source pixels, row by row.
float PatchCost(const ReferencePatch& patch, const PackedImage& source, const float homography[9],
                const PixelPlace& at);

inline constexpr float kNoMatch = 2.0f;

// The code for PatchCost that this processor can run, the fastest first. All give the same bits.
using PatchCostCode = float (*)(const ReferencePatch& patch, const PackedImage& source,
                                const float* homography, const PixelPlace& at);
std::vector<PatchCostCode> PatchCostCodes();

}  // namespace stucco
