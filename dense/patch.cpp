// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch.h"

#include <algorithm>
#include <cmath>
#include <cstring>

namespace stucco {
namespace {

constexpr float kSpatialSigma = 5;
constexpr float kColorSigma = 30;      // grey levels
constexpr float kLeastVariance = 4.0;  // grey levels squared; below is noise

using Floats = float __attribute__((vector_size(32)));
using Ints = int32_t __attribute__((vector_size(32)));

struct Offsets {
  alignas(32) float x[kPatchSamples] = {};
  alignas(32) float y[kPatchSamples] = {};
  float spatial[kPatchSamples] = {};  // 0 for padding
  Offsets() {
    int i = 0;
    for (int dy = -kPatchRadius; dy <= kPatchRadius; dy += 2) {
      for (int dx = -kPatchRadius; dx <= kPatchRadius; dx += 2, ++i) {
        x[i] = static_cast<float>(dx);
        y[i] = static_cast<float>(dy);
        spatial[i] =
            std::exp(-static_cast<float>(dx * dx + dy * dy) / (2 * kSpatialSigma * kSpatialSigma));
      }
    }
  }
};

const Offsets kOffsets;

bool IsInside(const PackedImage& image, const float h[9], float x, float y) {
  const float z = h[6] * x + h[7] * y + h[8];
  if (z <= 1e-6f) return false;
  const float u = (h[0] * x + h[1] * y + h[2]) / z;
  const float v = (h[3] * x + h[4] * y + h[5]) / z;
  return u >= 0 && v >= 0 && u < static_cast<float>(image.width - 1) &&
         v < static_cast<float>(image.height - 1);
}

}  // namespace

ReferencePatch MakeReferencePatch(const PackedImage& image, int x, int y) {
  ReferencePatch patch;
  float values[kPatchSamples];
  const float center = image.gray[static_cast<size_t>(y) * image.width + x];
  float weight_sum = 0;
  float mean = 0;
  for (int i = 0; i < kPatchSamples; ++i) {
    const int px = std::clamp(x + static_cast<int>(kOffsets.x[i]), 0, image.width - 1);
    const int py = std::clamp(y + static_cast<int>(kOffsets.y[i]), 0, image.height - 1);
    values[i] = image.gray[static_cast<size_t>(py) * image.width + px];
    const float difference = (values[i] - center) / kColorSigma;
    patch.weights[i] = kOffsets.spatial[i] * std::exp(-0.5f * difference * difference);
    weight_sum += patch.weights[i];
    mean += patch.weights[i] * values[i];
  }
  mean /= weight_sum;
  for (int i = 0; i < kPatchSamples; ++i) {
    patch.weights[i] /= weight_sum;
    patch.weighted[i] = patch.weights[i] * (values[i] - mean);
    patch.variance += patch.weighted[i] * (values[i] - mean);
  }
  return patch;
}

// Compiled twice, for processors with 256-bit vectors and for all others; both give the same bits,
// as no operation is fused or reordered.
__attribute__((target_clones("avx2", "default"))) float PatchCost(const ReferencePatch& patch,
                                                                  const PackedImage& source,
                                                                  const float homography[9],
                                                                  float x, float y) {
  if (patch.variance < kLeastVariance) return kNoMatch;
  constexpr float kR = kPatchRadius;
  if (!IsInside(source, homography, x - kR, y - kR) ||
      !IsInside(source, homography, x + kR, y - kR) ||
      !IsInside(source, homography, x - kR, y + kR) ||
      !IsInside(source, homography, x + kR, y + kR)) {
    return kNoMatch;
  }
  const float* h = homography;
  const float u0 = h[0] * x + h[1] * y + h[2];
  const float v0 = h[3] * x + h[4] * y + h[5];
  const float z0 = h[6] * x + h[7] * y + h[8];
  Floats sum = {};
  Floats squares = {};
  Floats product = {};
  const uint32_t* quads = source.quads.data();
  for (int i = 0; i < kPatchSamples; i += 8) {
    Floats dx, dy, weights, weighted;
    std::memcpy(&dx, kOffsets.x + i, 32);
    std::memcpy(&dy, kOffsets.y + i, 32);
    std::memcpy(&weights, patch.weights + i, 32);
    std::memcpy(&weighted, patch.weighted + i, 32);
    const Floats z = z0 + h[6] * dx + h[7] * dy;
    const Floats u = (u0 + h[0] * dx + h[1] * dy) / z;
    const Floats v = (v0 + h[3] * dx + h[4] * dy) / z;
    const Ints column = __builtin_convertvector(u, Ints);
    const Ints row = __builtin_convertvector(v, Ints);
    const Floats fx = u - __builtin_convertvector(column, Floats);
    const Floats fy = v - __builtin_convertvector(row, Floats);
    const Ints at = row * source.width + column;
    Ints quad;
    for (int lane = 0; lane < 8; ++lane) quad[lane] = static_cast<int32_t>(quads[at[lane]]);
    const Floats v00 = __builtin_convertvector(quad & 255, Floats);
    const Floats v01 = __builtin_convertvector((quad >> 8) & 255, Floats);
    const Floats v10 = __builtin_convertvector((quad >> 16) & 255, Floats);
    const Floats v11 = __builtin_convertvector((quad >> 24) & 255, Floats);
    const Floats top = v00 + fx * (v01 - v00);
    const Floats bottom = v10 + fx * (v11 - v10);
    const Floats value = top + fy * (bottom - top);
    sum += weights * value;
    squares += weights * value * value;
    product += weighted * value;
  }
  float mean = 0;
  float square = 0;
  float covariance = 0;
  for (int lane = 0; lane < 8; ++lane) {
    mean += sum[lane];
    square += squares[lane];
    covariance += product[lane];
  }
  const float variance = square - mean * mean;
  if (variance < kLeastVariance) return kNoMatch;
  return std::clamp(1 - covariance / std::sqrt(variance * patch.variance), 0.0f, kNoMatch);
}

}  // namespace stucco
