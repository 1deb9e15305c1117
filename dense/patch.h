// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "dense/view.h"

namespace stucco {

// A window of 11 x 11 pixels sampled every second pixel, without its corners: four vectors of
// eight.
inline constexpr int kPatchRadius = 5;
inline constexpr int kPatchSamples = 32;

// The reference side of a comparison, the same for every hypothesis at a pixel. Weights fall off
// with distance and grey difference (bilateral, as in Schoenberger et al. 2016), and sum to 1.
struct ReferencePatch {
  alignas(32) float weights[kPatchSamples];
  alignas(32) float weighted[kPatchSamples];  // weight * (value - mean)
  float variance = 0;
};

ReferencePatch MakeReferencePatch(const PackedImage& image, int x, int y);

// Takes a pixel's surroundings into a source: the offset (dx, dy) from the pixel goes to the
// homogeneous source pixel at + right * dx + down * dy, which moves by `nearer` as the plane's
// inverse depth there grows by one (the epipole).
struct PatchWarp {
  std::array<float, 3> at{};
  std::array<float, 3> right{};
  std::array<float, 3> down{};
  std::array<float, 3> nearer{};
};

// 1 - weighted normalised cross-correlation between the reference patch and where the warp takes it
// in `source`: 0 for a perfect match, kNoMatch when the patch leaves the image or either side has
// no texture.
float PatchCost(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp);

inline constexpr float kNoMatch = 2.0f;

// How the match changes with the plane: sums of a Gauss-Newton step in the plane's inverse depth,
// its slope to the right and its slope down. Brightness and contrast are free (they are projected
// out), as in the cost.
struct StepSums {
  std::array<float, 6> square{};  // 11, 12, 13, 22, 23, 33 of the normal matrix
  std::array<float, 3> slope{};   // half the gradient of the squared residuals
};

// Adds a source's part; nothing where the cost would be kNoMatch.
void AddStep(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp,
             StepSums& sums);

// The code for the above that this processor can run, the fastest first. All give the same bits.
struct PatchCode {
  ReferencePatch (*reference)(const PackedImage&, int x, int y);
  float (*cost)(const ReferencePatch&, const PackedImage&, const PatchWarp&);
  void (*add_step)(const ReferencePatch&, const PackedImage&, const PatchWarp&, StepSums&);
};
std::vector<PatchCode> PatchCodes();

}  // namespace stucco
