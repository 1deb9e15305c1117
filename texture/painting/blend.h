// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace stucco {

// A picture of a rectangle of texels, 3 values per texel, and where it shows the facet.
struct Layer {
  std::vector<float> rgb;
  std::vector<uint8_t> valid;
};

// Texels around a tile that change its blended inside: with kBlendLevels halvings, influence falls
// below a grey level there. Tiles blended with this margin, their corners at multiples of
// 2^kBlendLevels, fit together without a trace.
inline constexpr int kBlendLevels = 5;
inline constexpr int kBlendMargin = 128;

// Joins layers where the labels say, each detail over a band as wide as the detail is large (Burt &
// Adelson, "A Multiresolution Spline With Application to Image Mosaics", 1983). `labels` hold the
// index of the layer that owns a texel, or -1. Requires layers that are valid where they own.
// Invalid parts of a layer are replaced by the plain mosaic, so that nothing unseen leaks across a
// seam. Returns 3 values per texel; where nobody owns a texel, smoothly continued colours.
std::vector<float> BlendLayers(std::span<const Layer> layers, const std::vector<int>& labels,
                               int width, int height);

// The plain mosaic: every texel from its owner, the rest continued smoothly.
std::vector<float> JoinLayers(std::span<const Layer> layers, const std::vector<int>& labels,
                              int width, int height);

}  // namespace stucco
