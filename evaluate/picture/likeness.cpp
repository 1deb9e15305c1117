// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/likeness.h"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "evaluate/picture/misregistration.h"
#include "evaluate/picture/structure.h"

namespace stucco::evaluate {
namespace {

// A photo 45 degrees off the normal shifts what is as far off the plane by that much: less than a
// texel of what surveys are planned for.
constexpr float kOnPlane_m = 0.02f;
constexpr int kRim_px = 10;  // a window's diameter, less its centre

// Texels within kRim_px of a marked one, in a square.
void Grow(std::vector<uint8_t>& marks, ImageSize size) {
  const cv::Mat view(size.height_px, size.width_px, CV_8UC1, marks.data());
  const int side = 2 * kRim_px + 1;
  cv::Mat grown;
  cv::dilate(view, grown, cv::getStructuringElement(cv::MORPH_RECT, {side, side}));
  std::copy(grown.datastart, grown.dataend, marks.begin());
}

}  // namespace

Likeness LikenessOf(const PicturePair& pair, double texel_m) {
  return {Ssim(pair), Psnr(pair), texel_m * Misregistration(pair)};
}

WallParts PartsOfWall(std::span<const float> heights_m, const std::vector<uint8_t>& mask,
                      ImageSize size) {
  WallParts parts;
  parts.plane.assign(mask.size(), 0);
  parts.relief.assign(mask.size(), 0);
  double known = 0;
  double on_plane = 0;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0 || std::isnan(heights_m[i])) continue;
    const bool is_on_plane = std::abs(heights_m[i]) <= kOnPlane_m;
    (is_on_plane ? parts.plane : parts.relief)[i] = 1;
    known += 1;
    on_plane += is_on_plane;
  }
  if (known > 0) parts.plane_share = on_plane / known;
  Grow(parts.relief, size);
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0 || std::isnan(heights_m[i])) parts.relief[i] = 0;
  }
  return parts;
}

}  // namespace stucco::evaluate
