// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <opencv2/core.hpp>

#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate::internal {

// The picture's own bytes, R G B; only to be read from.
cv::Mat Rgb(const Image& image);

// Luma of the sRGB codes (Rec. 601: 0.299 R + 0.587 G + 0.114 B), floats from 0 to 255.
cv::Mat Luma(const Image& image);

// 255 where both pictures have content.
cv::Mat MaskOf(const PicturePair& pair);

enum class BeyondThePicture { kNothing, kContent };

// 255 at pixels whose window of (2 * radius + 1)^2 pixels has content everywhere. Whether a window
// may stick out of the picture is up to the measure.
cv::Mat WholeWindows(const cv::Mat& mask, int radius_px, BeyondThePicture beyond);

}  // namespace stucco::evaluate::internal
