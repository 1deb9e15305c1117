// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/decode_image.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/error.h"
#include "survey/internal/decode.h"
#include "survey/internal/jpeg.h"

namespace stucco {
namespace {

// OpenCV has B G R (A), and 16 bits where the file has.
cv::Mat ToRgb8(const cv::Mat& pixels) {
  cv::Mat bytes = pixels;
  if (pixels.depth() == CV_16U) pixels.convertTo(bytes, CV_8U, 1 / 257.0);
  if (bytes.depth() != CV_8U) return {};
  cv::Mat out;
  if (bytes.channels() == 1) return bytes;
  if (bytes.channels() == 3) cv::cvtColor(bytes, out, cv::COLOR_BGR2RGB);
  if (bytes.channels() == 4) cv::cvtColor(bytes, out, cv::COLOR_BGRA2RGBA);
  return out;
}

}  // namespace

cv::Mat internal::DecodeByOpenCv(std::string_view bytes) {
  if (bytes.empty()) return {};
  const cv::Mat encoded(1, static_cast<int>(bytes.size()), CV_8UC1,
                        const_cast<char*>(bytes.data()));  // only read from
  try {
    return cv::imdecode(encoded, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception&) {
    return {};
  }
}

Image DecodeImage(std::string_view bytes, const std::string& name) {
  if (internal::LooksLikeJpeg(bytes)) {
    return internal::DecodeJpeg(bytes, name, /*channels=*/0, /*max_side_px=*/0);
  }
  const cv::Mat pixels = ToRgb8(internal::DecodeByOpenCv(bytes));
  if (pixels.empty()) {
    throw Error(
        ErrorKind::kBadInput,
        fmt::format("{}: a damaged or unknown picture: {}", name, internal::Describe(bytes)),
        "save it as JPEG or PNG again");
  }
  Image image{pixels.cols, pixels.rows, pixels.channels(), {}};
  const cv::Mat whole = pixels.isContinuous() ? pixels : pixels.clone();
  image.data.assign(whole.data, whole.data + whole.total() * whole.elemSize());
  return image;
}

}  // namespace stucco
