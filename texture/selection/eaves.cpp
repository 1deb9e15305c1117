// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/selection/eaves.h"

#include <algorithm>
#include <cstdint>
#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

// The cheapest of the pictures that show a texel freely, -1 for none.
int CheapestFree(std::span<const RasterPicture> pictures, size_t texel) {
  int best = -1;
  for (size_t p = 0; p < pictures.size(); ++p) {
    if (pictures[p].sight[texel] != Sight::kFree) continue;
    if (best < 0 || pictures[p].cost[texel] < pictures[best].cost[texel])
      best = static_cast<int>(p);
  }
  return best;
}

// A connected piece of hidden texels.
struct HiddenPiece {
  float half_width = 0;  // where it is widest
  bool at_house = false;
};

}  // namespace

void ClearEaves(const TexelGrid& raster, std::span<const RasterPicture> pictures, double half_width,
                std::vector<int>& owner) {
  // With a rim of what is not hidden, so that pieces at the edge have a width.
  cv::Mat hidden = cv::Mat::zeros(raster.height + 2, raster.width + 2, CV_8U);
  cv::Mat house = cv::Mat::zeros(hidden.size(), CV_8U);
  const auto at = [&](size_t i) {
    return cv::Point(static_cast<int>(i % raster.width) + 1,
                     static_cast<int>(i / raster.width) + 1);
  };
  for (size_t i = 0; i < owner.size(); ++i) {
    if (owner[i] < 0) {
      house.at<uint8_t>(at(i)) = 1;
    } else if (pictures[owner[i]].sight[i] == Sight::kBehind) {
      hidden.at<uint8_t>(at(i)) = 1;
    }
  }
  cv::dilate(house, house, cv::Mat::ones(3, 3, CV_8U));
  cv::Mat number;
  cv::Mat distance;
  std::vector<HiddenPiece> pieces(cv::connectedComponents(hidden, number, 8, CV_32S));
  cv::distanceTransform(hidden, distance, cv::DIST_L2, cv::DIST_MASK_PRECISE);
  for (size_t i = 0; i < owner.size(); ++i) {
    HiddenPiece& piece = pieces[number.at<int>(at(i))];
    piece.half_width = std::max(piece.half_width, distance.at<float>(at(i)));
    piece.at_house |= house.at<uint8_t>(at(i)) != 0;
  }
  for (size_t i = 0; i < owner.size(); ++i) {
    if (hidden.at<uint8_t>(at(i)) == 0) continue;
    const HiddenPiece& piece = pieces[number.at<int>(at(i))];
    if (piece.at_house && piece.half_width <= half_width) owner[i] = CheapestFree(pictures, i);
  }
}

}  // namespace stucco
