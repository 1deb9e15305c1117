// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/image.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/encode_image.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/internal/decode.h"
#include "survey/internal/jpeg.h"

namespace stucco {
namespace {

// OpenCV stores colours as B G R.
Image FromOpenCv(const cv::Mat& pixels) {
  Image image{pixels.cols, pixels.rows, pixels.channels(), {}};
  image.data.resize(pixels.total() * pixels.elemSize());
  cv::Mat out(pixels.rows, pixels.cols, pixels.type(), image.data.data());
  if (image.channels == 1) {
    pixels.copyTo(out);
  } else {
    cv::cvtColor(pixels, out, cv::COLOR_BGR2RGB);
  }
  return image;
}

Image DecodePng(const std::string& bytes, const std::string& name) {
  const cv::Mat pixels = internal::DecodeByOpenCv(bytes);
  if (pixels.empty()) {
    throw Error(ErrorKind::kBadInput, fmt::format("{}: damaged PNG", name),
                "run the stage that writes this file again");
  }
  if (pixels.type() != CV_8UC1 && pixels.type() != CV_8UC3) {
    throw Error(ErrorKind::kBadInput,
                fmt::format("{}: PNG is not of 8-bit grey or RGB pixels", name));
  }
  return FromOpenCv(pixels);
}

}  // namespace

ImageSize ReadJpegSize(const std::filesystem::path& path) {
  return internal::JpegSizeOf(path);
}

Image ReadJpeg(const std::filesystem::path& path, int channels, int max_side_px) {
  return internal::DecodeJpeg(ReadFile(path), path.string(), channels, max_side_px);
}

void WriteImage(const Image& image, const std::filesystem::path& path, int quality) {
  WriteFile(path, EncodeImage(image, path, quality));
}

Image ReadImage(const std::filesystem::path& path) {
  const std::string bytes = ReadFile(path);
  if (internal::LooksLikeJpeg(bytes)) {
    return internal::DecodeJpeg(bytes, path.string(), /*channels=*/0, /*max_side_px=*/0);
  }
  if (bytes.starts_with("\x89PNG")) return DecodePng(bytes, path.string());
  throw Error(ErrorKind::kBadInput, fmt::format("{}: neither PNG nor JPEG but {}", path.string(),
                                                internal::Describe(bytes)));
}

}  // namespace stucco
