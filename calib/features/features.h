// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "survey/image.h"

namespace stucco {

struct Keypoint {
  float x = 0;  // full-resolution pixels, centre of the top-left pixel at (0.5, 0.5)
  float y = 0;
  float scale = 0;  // standard deviation of the blob, full-resolution pixels
};

// SIFT descriptors (Lowe 2004) as RootSIFT (Arandjelovic & Zisserman 2012), quantised to 512 *
// value.
struct Features {
  std::vector<Keypoint> keypoints;
  std::vector<std::array<uint8_t, 3>> colors;
  std::vector<std::array<uint8_t, 128>> descriptors;

  size_t size() const { return keypoints.size(); }
};

struct FeatureOptions {
  int max_image_px = 3200;
  int max_features = 8192;
};

// Requires an image of three channels. It is the photo scaled down so that its longer side is at
// most max_image_px; keypoints are scaled back to `full`. When there are more than max_features,
// the strongest of every part of the image are kept, so that all of the image takes part.
Features DetectFeatures(const Image& image, ImageSize full, const FeatureOptions& options);

// Checkpoint format; throws Error (kBadInput) on anything that does not fit.
std::string Serialize(const Features& features);
Features DeserializeFeatures(std::string_view bytes);

// Indices of the `count` keypoints that spread over the image: cells of a grid take turns, each
// giving its strongest keypoint left. Ascending.
std::vector<int> SelectSpread(const std::vector<Keypoint>& keypoints,
                              const std::vector<float>& strengths, ImageSize size, int count);

}  // namespace stucco
