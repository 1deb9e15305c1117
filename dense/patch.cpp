// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "dense/patch.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace stucco {
namespace {

constexpr float kSpatialSigma = 5;
constexpr float kColorSigma = 30;      // grey levels
constexpr float kLeastVariance = 1.0;  // grey levels squared; less is noise

using Floats = float __attribute__((vector_size(32)));
using Ints = int32_t __attribute__((vector_size(32)));

struct Offsets {
  alignas(32) float x[kPatchSamples] = {};
  alignas(32) float y[kPatchSamples] = {};
  alignas(32) float spatial[kPatchSamples] = {};
  Offsets() {
    int i = 0;
    for (int dy = -kPatchRadius; dy <= kPatchRadius; dy += 2) {
      for (int dx = -kPatchRadius; dx <= kPatchRadius; dx += 2) {
        if (dx * dx == kPatchRadius * kPatchRadius && dy * dy == dx * dx) continue;
        x[i] = static_cast<float>(dx);
        y[i] = static_cast<float>(dy);
        spatial[i] =
            std::exp(-static_cast<float>(dx * dx + dy * dy) / (2 * kSpatialSigma * kSpatialSigma));
        ++i;
      }
    }
  }
};

const Offsets kOffsets;

// Of the difference of two grey values; floats as words, to be fetched as pixels are.
struct ColorWeights {
  uint32_t of[256];
  ColorWeights() {
    for (int i = 0; i < 256; ++i) {
      const float difference = static_cast<float>(i) / kColorSigma;
      of[i] = std::bit_cast<uint32_t>(std::exp(-0.5f * difference * difference));
    }
  }
};

const ColorWeights kColorWeights;

__attribute__((always_inline)) inline void Clamp(int last, Ints& values) {
  const Ints least = {};
  const Ints most = least + last;
  values = values < least ? least : values;
  values = values > most ? most : values;
}

__attribute__((always_inline)) inline float Sum(const Floats& of) {
  float sum = 0;
  for (int lane = 0; lane < 8; ++lane) sum += of[lane];
  return sum;
}

// This and what follows take a way to fetch the words at eight places. They are inlined into what
// is compiled for one kind of processor; all of them give the same bits, as no operation is fused
// or reordered.
template <typename Fetch>
__attribute__((always_inline)) inline ReferencePatch ReferenceBy(const Fetch& fetch,
                                                                 const PackedImage& image, int x,
                                                                 int y) {
  const int center = image.gray[static_cast<size_t>(y) * image.width + x];
  Floats values[kPatchSamples / 8], weights[kPatchSamples / 8];
  Floats weight_sum = {}, weighted_sum = {};
  for (int i = 0; i < kPatchSamples / 8; ++i) {
    Floats dx, dy, spatial;
    std::memcpy(&dx, kOffsets.x + 8 * i, sizeof dx);
    std::memcpy(&dy, kOffsets.y + 8 * i, sizeof dy);
    std::memcpy(&spatial, kOffsets.spatial + 8 * i, sizeof spatial);
    Ints column = __builtin_convertvector(dx, Ints) + x;
    Ints row = __builtin_convertvector(dy, Ints) + y;
    Clamp(image.width - 1, column);
    Clamp(image.height - 1, row);
    Ints quad, bits;
    fetch(image.quads.data(), row * image.width + column, quad);
    const Ints value = quad & 255;
    const Ints difference = value - center;
    fetch(kColorWeights.of, difference < 0 ? -difference : difference, bits);
    values[i] = __builtin_convertvector(value, Floats);
    weights[i] = spatial * reinterpret_cast<Floats>(bits);
    weight_sum += weights[i];
    weighted_sum += weights[i] * values[i];
  }
  const float scale = 1 / Sum(weight_sum);
  const float mean = Sum(weighted_sum) * scale;
  ReferencePatch patch;
  Floats variance = {};
  for (int i = 0; i < kPatchSamples / 8; ++i) {
    weights[i] *= scale;
    const Floats weighted = weights[i] * (values[i] - mean);
    variance += weighted * (values[i] - mean);
    std::memcpy(patch.weights + 8 * i, &weights[i], sizeof weighted);
    std::memcpy(patch.weighted + 8 * i, &weighted, sizeof weighted);
  }
  patch.variance = Sum(variance);
  return patch;
}

// Whether the window's corners are inside of the source; then all of it is.
__attribute__((always_inline)) inline bool IsInside(const PatchWarp& warp,
                                                    const PackedImage& source) {
  constexpr float kR = kPatchRadius;
  // Each corner stands in the vector twice.
  const Floats dx = {-kR, kR, -kR, kR, -kR, kR, -kR, kR};
  const Floats dy = {-kR, -kR, kR, kR, -kR, -kR, kR, kR};
  const Floats u = warp.at[0] + warp.right[0] * dx + warp.down[0] * dy;
  const Floats v = warp.at[1] + warp.right[1] * dx + warp.down[1] * dy;
  const Floats z = warp.at[2] + warp.right[2] * dx + warp.down[2] * dy;
  const Ints inside = (z > 1e-6f) & (u >= 0) & (v >= 0) &
                      (u < static_cast<float>(source.width - 1) * z) &
                      (v < static_cast<float>(source.height - 1) * z);
  return (inside[0] & inside[1] & inside[2] & inside[3]) != 0;
}

// Eight places in a source, the grey values there, and how those change to the right and down.
struct Sampled {
  Floats u, v, inverse_z;
  Floats value, to_right, to_down;
};

template <typename Fetch>
__attribute__((always_inline)) inline Sampled Sample(const Fetch& fetch, const PackedImage& source,
                                                     const PatchWarp& warp, const Floats& dx,
                                                     const Floats& dy) {
  Sampled at;
  at.inverse_z = 1 / (warp.at[2] + warp.right[2] * dx + warp.down[2] * dy);
  at.u = (warp.at[0] + warp.right[0] * dx + warp.down[0] * dy) * at.inverse_z;
  at.v = (warp.at[1] + warp.right[1] * dx + warp.down[1] * dy) * at.inverse_z;
  const Ints column = __builtin_convertvector(at.u, Ints);
  const Ints row = __builtin_convertvector(at.v, Ints);
  const Floats fx = at.u - __builtin_convertvector(column, Floats);
  const Floats fy = at.v - __builtin_convertvector(row, Floats);
  const Ints place = row * source.width + column;
  Ints quad;
  fetch(source.quads.data(), place, quad);
  const Floats v00 = __builtin_convertvector(quad & 255, Floats);
  const Floats v01 = __builtin_convertvector((quad >> 8) & 255, Floats);
  const Floats v10 = __builtin_convertvector((quad >> 16) & 255, Floats);
  const Floats v11 = __builtin_convertvector((quad >> 24) & 255, Floats);
  const Floats top = v00 + fx * (v01 - v00);
  const Floats bottom = v10 + fx * (v11 - v10);
  at.to_down = bottom - top;
  at.value = top + fy * at.to_down;
  at.to_right = (v01 - v00) + fy * ((v11 - v10) - (v01 - v00));
  return at;
}

// Eight samples of the window and what the reference weighs them with.
struct Lanes {
  Floats dx, dy;
  Floats weights, weighted;
};

__attribute__((always_inline)) inline Lanes LanesAt(const ReferencePatch& patch, int first) {
  Lanes lanes;
  std::memcpy(&lanes.dx, kOffsets.x + first, sizeof lanes.dx);
  std::memcpy(&lanes.dy, kOffsets.y + first, sizeof lanes.dy);
  std::memcpy(&lanes.weights, patch.weights + first, sizeof lanes.weights);
  std::memcpy(&lanes.weighted, patch.weighted + first, sizeof lanes.weighted);
  return lanes;
}

template <typename Fetch>
__attribute__((always_inline)) inline float CostBy(const Fetch& fetch, const ReferencePatch& patch,
                                                   const PackedImage& source,
                                                   const PatchWarp& warp) {
  if (patch.variance < kLeastVariance || !IsInside(warp, source)) return kNoMatch;
  Floats sum = {};
  Floats squares = {};
  Floats product = {};
  for (int i = 0; i < kPatchSamples; i += 8) {
    const auto [dx, dy, weights, weighted] = LanesAt(patch, i);
    const Sampled at = Sample(fetch, source, warp, dx, dy);
    sum += weights * at.value;
    squares += weights * at.value * at.value;
    product += weighted * at.value;
  }
  const float mean = Sum(sum);
  const float variance = Sum(squares) - mean * mean;
  if (variance < kLeastVariance) return kNoMatch;
  return std::clamp(1 - Sum(product) / std::sqrt(variance * patch.variance), 0.0f, kNoMatch);
}

// Weighted sums over a window of a source's values v and of their derivatives d by the inverse
// depth, times 1, dx and dy: by the weights, with the reference, with each other.
struct DerivativeSums {
  Floats value = {}, value_square = {}, value_reference = {};
  Floats mean[3] = {}, reference[3] = {}, product[3] = {};
  Floats square[6] = {};
};

template <typename Fetch>
__attribute__((always_inline)) inline DerivativeSums SumDerivatives(const Fetch& fetch,
                                                                    const ReferencePatch& patch,
                                                                    const PackedImage& source,
                                                                    const PatchWarp& warp) {
  DerivativeSums sums;
  for (int i = 0; i < kPatchSamples; i += 8) {
    const auto [dx, dy, weights, weighted] = LanesAt(patch, i);
    const Sampled at = Sample(fetch, source, warp, dx, dy);
    const Floats d = (at.to_right * (warp.nearer[0] - at.u * warp.nearer[2]) +
                      at.to_down * (warp.nearer[1] - at.v * warp.nearer[2])) *
                     at.inverse_z;
    const Floats by[3] = {d, d * dx, d * dy};
    const Floats weighted_value = weights * at.value;
    sums.value += weighted_value;
    sums.value_square += weighted_value * at.value;
    sums.value_reference += weighted * at.value;
    int entry = 0;
    for (int row = 0; row < 3; ++row) {
      const Floats weighted_row = weights * by[row];
      sums.mean[row] += weighted_row;
      sums.reference[row] += weighted * by[row];
      sums.product[row] += weighted_row * at.value;
      for (int column = row; column < 3; ++column, ++entry) {
        sums.square[entry] += weighted_row * by[column];
      }
    }
  }
  return sums;
}

template <typename Fetch>
__attribute__((always_inline)) inline void AddStepBy(const Fetch& fetch,
                                                     const ReferencePatch& patch,
                                                     const PackedImage& source,
                                                     const PatchWarp& warp, StepSums& sums) {
  if (patch.variance < kLeastVariance || !IsInside(warp, source)) return;
  const DerivativeSums of = SumDerivatives(fetch, patch, source, warp);
  const float mean = Sum(of.value);
  const float variance = Sum(of.value_square) - mean * mean;
  if (variance < kLeastVariance) return;
  const float with_reference = Sum(of.value_reference) / patch.variance;
  float means[3];
  float references[3];
  for (int k = 0; k < 3; ++k) {
    means[k] = Sum(of.mean[k]);
    references[k] = Sum(of.reference[k]);
  }
  // A source of more contrast is no better witness.
  const float scale = 1 / variance;
  int entry = 0;
  for (int row = 0; row < 3; ++row) {
    const float slope = Sum(of.product[row]) - means[row] * mean - references[row] * with_reference;
    sums.slope[row] += scale * slope;
    for (int column = row; column < 3; ++column, ++entry) {
      sums.square[entry] += scale * (Sum(of.square[entry]) - means[row] * means[column] -
                                     references[row] * references[column] / patch.variance);
    }
  }
}

#if defined(__x86_64__)

struct Gathers {
  __attribute__((target("avx2"))) void operator()(const uint32_t* words, const Ints& place,
                                                  Ints& found) const {
    found = reinterpret_cast<Ints>(_mm256_i32gather_epi32(reinterpret_cast<const int*>(words),
                                                          reinterpret_cast<__m256i>(place), 4));
  }
};

__attribute__((target("avx2"))) ReferencePatch ReferenceByGathers(const PackedImage& image, int x,
                                                                  int y) {
  return ReferenceBy(Gathers(), image, x, y);
}

__attribute__((target("avx2"))) float CostByGathers(const ReferencePatch& patch,
                                                    const PackedImage& source,
                                                    const PatchWarp& warp) {
  return CostBy(Gathers(), patch, source, warp);
}

__attribute__((target("avx2"))) void AddStepByGathers(const ReferencePatch& patch,
                                                      const PackedImage& source,
                                                      const PatchWarp& warp, StepSums& sums) {
  AddStepBy(Gathers(), patch, source, warp, sums);
}

#endif

struct Loads {
  void operator()(const uint32_t* words, const Ints& place, Ints& found) const {
    for (int lane = 0; lane < 8; ++lane) found[lane] = static_cast<int32_t>(words[place[lane]]);
  }
};

ReferencePatch ReferenceByLoads(const PackedImage& image, int x, int y) {
  return ReferenceBy(Loads(), image, x, y);
}

float CostByLoads(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp) {
  return CostBy(Loads(), patch, source, warp);
}

void AddStepByLoads(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp,
                    StepSums& sums) {
  AddStepBy(Loads(), patch, source, warp, sums);
}

const PatchCode& Fastest() {
  static const PatchCode fastest = PatchCodes().front();
  return fastest;
}

}  // namespace

std::vector<PatchCode> PatchCodes() {
  std::vector<PatchCode> codes;
#if defined(__x86_64__)
  if (__builtin_cpu_supports("avx2")) {
    codes.push_back({ReferenceByGathers, CostByGathers, AddStepByGathers});
  }
#endif
  codes.push_back({ReferenceByLoads, CostByLoads, AddStepByLoads});
  return codes;
}

ReferencePatch MakeReferencePatch(const PackedImage& image, int x, int y) {
  return Fastest().reference(image, x, y);
}

float PatchCost(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp) {
  return Fastest().cost(patch, source, warp);
}

void AddStep(const ReferencePatch& patch, const PackedImage& source, const PatchWarp& warp,
             StepSums& sums) {
  Fastest().add_step(patch, source, warp, sums);
}

}  // namespace stucco
