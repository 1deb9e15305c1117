// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/internal/planes.h"

#include <fmt/format.h>

#include <opencv2/imgproc.hpp>

#include "survey/error.h"

namespace stucco::evaluate {

void CheckPair(const PicturePair& pair) {
  const auto is_whole = [](const Image& image) {
    return image.width_px > 0 && image.height_px > 0 && image.channels == 3 &&
           image.data.size() == size_t{3} * image.width_px * image.height_px;
  };
  const size_t pixels = pair.truth.data.size() / 3;
  if (is_whole(pair.truth) && is_whole(pair.result) &&
      pair.truth.width_px == pair.result.width_px &&
      pair.truth.height_px == pair.result.height_px &&
      (pair.mask.empty() || pair.mask.size() == pixels)) {
    return;
  }
  throw Error(ErrorKind::kStageFailed,
              fmt::format("pictures that cannot be compared: {} x {} with {} channels and {} x {} "
                          "with {} channels, mask of {} pixels",
                          pair.truth.width_px, pair.truth.height_px, pair.truth.channels,
                          pair.result.width_px, pair.result.height_px, pair.result.channels,
                          pair.mask.size()));
}

namespace internal {

cv::Mat Rgb(const Image& image) {
  // OpenCV has no type for a matrix that is only read from.
  return {image.height_px, image.width_px, CV_8UC3, const_cast<uint8_t*>(image.data.data())};
}

cv::Mat Luma(const Image& image) {
  cv::Mat codes;
  Rgb(image).convertTo(codes, CV_32F);
  cv::Mat luma;
  cv::transform(codes, luma, cv::Matx13f(0.299f, 0.587f, 0.114f));
  return luma;
}

cv::Mat MaskOf(const PicturePair& pair) {
  cv::Mat mask(pair.truth.height_px, pair.truth.width_px, CV_8UC1, cv::Scalar(255));
  if (!pair.mask.empty()) {
    const cv::Mat given(mask.rows, mask.cols, CV_8UC1, const_cast<uint8_t*>(pair.mask.data()));
    mask = given != 0;
  }
  return mask;
}

cv::Mat WholeWindows(const cv::Mat& mask, int radius_px, BeyondThePicture beyond) {
  cv::Mat whole;
  const cv::Scalar outside(beyond == BeyondThePicture::kContent ? 255 : 0);
  const int side = 2 * radius_px + 1;
  cv::erode(mask, whole, cv::getStructuringElement(cv::MORPH_RECT, {side, side}), {-1, -1}, 1,
            cv::BORDER_CONSTANT, outside);
  return whole;
}

}  // namespace internal
}  // namespace stucco::evaluate
