// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

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

// Of the difference of two grey values.
struct ColorWeights {
  float of[256];
  ColorWeights() {
    for (int i = 0; i < 256; ++i) {
      const float difference = static_cast<float>(i) / kColorSigma;
      of[i] = std::exp(-0.5f * difference * difference);
    }
  }
};

const ColorWeights kColorWeights;

}  // namespace

ReferencePatch MakeReferencePatch(const PackedImage& image, int x, int y) {
  ReferencePatch patch;
  float values[kPatchSamples];
  const int center = image.gray[static_cast<size_t>(y) * image.width + x];
  float weight_sum = 0;
  float mean = 0;
  for (int i = 0; i < kPatchSamples; ++i) {
    const int px = std::clamp(x + static_cast<int>(kOffsets.x[i]), 0, image.width - 1);
    const int py = std::clamp(y + static_cast<int>(kOffsets.y[i]), 0, image.height - 1);
    const int value = image.gray[static_cast<size_t>(py) * image.width + px];
    values[i] = static_cast<float>(value);
    patch.weights[i] = kOffsets.spatial[i] * kColorWeights.of[std::abs(value - center)];
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

namespace {

// The cost, with a way to fetch the words at eight places. Inlined into what is compiled for one
// kind of processor; all of them give the same bits, as no operation is fused or reordered.
template <typename Fetch>
__attribute__((always_inline)) inline float CostBy(const Fetch& fetch, const ReferencePatch& patch,
                                                   const PackedImage& source, const float* h,
                                                   const PixelPlace& at) {
  if (patch.variance < kLeastVariance) return kNoMatch;
  const float u0 = h[0] * at.x + h[1] * at.y + h[2];
  const float v0 = h[3] * at.x + h[4] * at.y + h[5];
  const float z0 = h[6] * at.x + h[7] * at.y + h[8];
  {
    // The window's corners are inside of the picture; each stands in the vector twice.
    constexpr float kR = kPatchRadius;
    const Floats dx = {-kR, kR, -kR, kR, -kR, kR, -kR, kR};
    const Floats dy = {-kR, -kR, kR, kR, -kR, -kR, kR, kR};
    const Floats z = z0 + h[6] * dx + h[7] * dy;
    const Floats u = u0 + h[0] * dx + h[1] * dy;
    const Floats v = v0 + h[3] * dx + h[4] * dy;
    const Ints inside = (z > 1e-6f) & (u >= 0) & (v >= 0) &
                        (u < static_cast<float>(source.width - 1) * z) &
                        (v < static_cast<float>(source.height - 1) * z);
    if ((inside[0] & inside[1] & inside[2] & inside[3]) == 0) return kNoMatch;
  }
  Floats sum = {};
  Floats squares = {};
  Floats product = {};
  for (int i = 0; i < kPatchSamples; i += 8) {
    Floats dx, dy, weights, weighted;
    std::memcpy(&dx, kOffsets.x + i, 32);
    std::memcpy(&dy, kOffsets.y + i, 32);
    std::memcpy(&weights, patch.weights + i, 32);
    std::memcpy(&weighted, patch.weighted + i, 32);
    const Floats inverse_z = 1 / (z0 + h[6] * dx + h[7] * dy);
    const Floats u = (u0 + h[0] * dx + h[1] * dy) * inverse_z;
    const Floats v = (v0 + h[3] * dx + h[4] * dy) * inverse_z;
    const Ints column = __builtin_convertvector(u, Ints);
    const Ints row = __builtin_convertvector(v, Ints);
    const Floats fx = u - __builtin_convertvector(column, Floats);
    const Floats fy = v - __builtin_convertvector(row, Floats);
    const Ints place = row * source.width + column;
    Ints quad;
    fetch(source.quads.data(), place, quad);
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

#if defined(__x86_64__)

__attribute__((target("avx2"))) float CostByGathers(const ReferencePatch& patch,
                                                    const PackedImage& source, const float* h,
                                                    const PixelPlace& at) {
  const auto fetch =
      [](const uint32_t* words, const Ints& place, Ints& found) __attribute__((target("avx2"))) {
    found = reinterpret_cast<Ints>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(words),
                                                          reinterpret_cast<__m256i>(place), 4));
  };
  return CostBy(fetch, patch, source, h, at);
}

#endif

float CostByLoads(const ReferencePatch& patch, const PackedImage& source, const float* h,
                  const PixelPlace& at) {
  const auto fetch = [](const uint32_t* words, const Ints& place, Ints& found) {
    for (int lane = 0; lane < 8; ++lane) found[lane] = static_cast<int32_t>(words[place[lane]]);
  };
  return CostBy(fetch, patch, source, h, at);
}

}  // namespace

std::vector<PatchCostCode> PatchCostCodes() {
  std::vector<PatchCostCode> codes;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) codes.push_back(CostByGathers);
#endif
  codes.push_back(CostByLoads);
  return codes;
}

float PatchCost(const ReferencePatch& patch, const PackedImage& source, const float homography[9],
                const PixelPlace& at) {
  static const PatchCostCode fastest = PatchCostCodes().front();
  return fastest(patch, source, homography, at);
}

}  // namespace stucco
