// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stucco {

// How much brighter one photo shows the same surface than another, per channel.
struct ColourRatio {
  int a = -1;  // indices of the photos
  int b = -1;
  Eigen::Vector3d log_ratio = Eigen::Vector3d::Zero();  // log(colour in a / colour in b)
  double weight = 0;                                    // number of texels it is the median of
};

// The part of a difference between logarithms of colours that brighter light does not make.
Eigen::Vector3d HueOf(const Eigen::Vector3d& logs);

// The median ratio over the texels that both show freely and that are neither black nor clipped
// in either; nothing with fewer than 24 of them. Colours are 3 per texel, 0 to 255.
std::optional<ColourRatio> MeasureRatio(int a, int b, std::span<const float> rgb_a,
                                        std::span<const float> rgb_b,
                                        std::span<const uint8_t> both_show);

// Gains per photo and channel that make the photos agree: least squares on the logarithms over all
// overlaps of the whole model, with Huber weights, drawn to 1 (Brown & Lowe, "Automatic Panoramic
// Image Stitching using Invariant Features", 2007, on ratios). Hues that only one photo has are
// held near those of the others. Photos without overlap keep 1.
std::vector<Eigen::Vector3d> SolveGains(std::span<const ColourRatio> ratios, size_t photos);

// What brings all of `a` to their `b`, when each ratio is of another facet and of the same two
// days: the median of each channel, so that a facade that was painted over does not recolour the
// others. One value for all channels of fewer than three facets, where a new colour and another
// light look the same, and where facets do not agree on the hue. 1 without ratios.
Eigen::Vector3d CommonGain(std::span<const ColourRatio> ratios);

}  // namespace stucco
