// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "capture_ingest/health.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/error.h"

namespace stucco {
namespace {

// The longer side of a picture of the same shape with one megapixel; 0 when it has fewer.
int OneMegapixelSide(ImageSize size) {
  const double pixels = static_cast<double>(size.width_px) * size.height_px;
  if (pixels <= 1e6) return 0;
  return static_cast<int>(
      std::lround(std::max(size.width_px, size.height_px) * std::sqrt(1e6 / pixels)));
}

// Variance of the Laplacian (Pech-Pacheco et al., "Diatom autofocusing in brightfield microscopy",
// 2000).
double Sharpness(const cv::Mat& grey) {
  cv::Mat laplacian;
  cv::Laplacian(grey, laplacian, CV_32F);
  cv::Scalar mean;
  cv::Scalar deviation;
  cv::meanStdDev(laplacian, mean, deviation);
  return deviation[0] * deviation[0];
}

std::string Thumbnail(const cv::Mat& rgb) {
  const double scale = std::min({1.0, static_cast<double>(kThumbnailWidth_px) / rgb.cols,
                                 static_cast<double>(kThumbnailHeight_px) / rgb.rows});
  const cv::Size size(std::max(1, static_cast<int>(std::lround(rgb.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(rgb.rows * scale))));
  cv::Mat small;
  cv::resize(rgb, small, size, 0, 0, cv::INTER_AREA);
  cv::cvtColor(small, small, cv::COLOR_RGB2BGR);
  std::vector<uchar> bytes;
  cv::imencode(".jpg", small, bytes, {cv::IMWRITE_JPEG_QUALITY, 88});
  return {bytes.begin(), bytes.end()};
}

// The next number of a line of numbers separated by blanks.
template <typename Value>
Value TakeNumber(std::string_view& text) {
  Value value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc()) {
    throw Error(ErrorKind::kBadInput, "stored photo check: malformed");
  }
  text.remove_prefix(std::min<size_t>(text.size(), end - text.data() + 1));
  return value;
}

}  // namespace

PhotoHealth CheckHealth(const std::filesystem::path& path) {
  PhotoHealth health;
  health.size = ReadJpegSize(path);
  Image image = ReadJpeg(path, 3, OneMegapixelSide(health.size));
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3, image.data.data());
  cv::Mat grey;
  cv::cvtColor(rgb, grey, cv::COLOR_RGB2GRAY);
  health.sharpness = Sharpness(grey);
  health.thumbnail = Thumbnail(rgb);
  return health;
}

std::string Serialized(const PhotoHealth& health) {
  return fmt::format("{} {} {}\n{}", health.size.width_px, health.size.height_px, health.sharpness,
                     health.thumbnail);
}

PhotoHealth ParseHealth(std::string_view bytes) {
  PhotoHealth health;
  health.size.width_px = TakeNumber<int>(bytes);
  health.size.height_px = TakeNumber<int>(bytes);
  health.sharpness = TakeNumber<double>(bytes);
  health.thumbnail = bytes;
  return health;
}

}  // namespace stucco
