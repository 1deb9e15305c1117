// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace stucco {

// How much brighter one photo shows the same surface than another, per channel. Colours are codes
// of photos, which follow light about as a power does: what brightens all light by a factor
// multiplies all codes by one.
struct ColourRatio {
  int a = -1;  // indices of the photos
  int b = -1;
  Eigen::Vector3d log_ratio = Eigen::Vector3d::Zero();  // log(colour in a / colour in b)
  double weight = 0;                                    // number of texels it is the median of
  // Means over these texels of what the lens's falloff goes by: CornerShare and its square.
  Eigen::Vector2d corner_a = Eigen::Vector2d::Zero();
  Eigen::Vector2d corner_b = Eigen::Vector2d::Zero();
};

// The part of a difference between logarithms of colours that brighter light does not make.
Eigen::Vector3d HueOf(const Eigen::Vector3d& logs);

// Factors of codes from their logarithms, none above 4 or below a quarter: more is no light.
Eigen::Vector3d GainOf(const Eigen::Vector3d& logs);

// What one photo shows of some texels.
struct PhotoColours {
  int photo = -1;
  std::span<const float> rgb;           // 3 per texel, 0 to 255
  std::span<const float> corner_share;  // CornerShare of where it shows them; empty: not known
};

// The median ratio over the texels that both show freely and that are neither black nor clipped
// in either; nothing with fewer than 24 of them. Where these are many, up to four, of texels that
// lie alike in the two pictures: between them, exposures are the same and falloffs differ.
std::vector<ColourRatio> MeasureRatios(const PhotoColours& a, const PhotoColours& b,
                                       std::span<const uint8_t> both_show);

// What brings all of `a` to their `b`, when each ratio is of another facet and of the same two
// days: the median of each channel, so that a facade that was painted over does not recolour the
// others. One value for all channels of fewer than three facets, where a new colour and another
// light look the same, and where facets do not agree on the hue. 1 without ratios.
Eigen::Vector3d CommonGain(std::span<const ColourRatio> ratios);

}  // namespace stucco
