// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/encode_image.h"

#include <fmt/format.h>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <vector>

#include "survey/error.h"
#include "survey/text.h"

namespace stucco {
namespace {

void CheckIsWhole(const Image& image, const std::filesystem::path& path) {
  const bool has_size = image.width_px > 0 && image.height_px > 0;
  const bool has_channels = image.channels == 1 || image.channels == 3;
  if (has_size && has_channels &&
      image.data.size() == size_t{1} * image.width_px * image.height_px * image.channels) {
    return;
  }
  throw Error(ErrorKind::kStageFailed,
              fmt::format("{}: cannot be written: {} bytes are no picture of {} x {} with {} "
                          "channels",
                          path.string(), image.data.size(), image.width_px, image.height_px,
                          image.channels));
}

// OpenCV stores colours as B G R.
cv::Mat ToOpenCv(const Image& image) {
  // The matrix is only read from; OpenCV has no type for that.
  cv::Mat pixels(image.height_px, image.width_px, CV_8UC(image.channels),
                 const_cast<uint8_t*>(image.data.data()));
  if (image.channels == 1) return pixels;
  cv::Mat bgr;
  cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

}  // namespace

std::string EncodeImage(const Image& image, const std::filesystem::path& path, int quality) {
  CheckIsWhole(image, path);
  const std::string extension = LowerCase(path.extension().string());
  const bool is_jpeg = extension == ".jpg" || extension == ".jpeg";
  if (!is_jpeg && extension != ".png") {
    throw Error(ErrorKind::kUsage, fmt::format("{}: pictures are written as .jpg or .png, not {}",
                                               path.string(), extension));
  }
  // Stronger PNG compression costs several times the time for a few percent.
  constexpr int kPngCompression = 3;
  const std::vector<int> parameters =
      is_jpeg ? std::vector<int>{cv::IMWRITE_JPEG_QUALITY, std::clamp(quality, 1, 100)}
              : std::vector<int>{cv::IMWRITE_PNG_COMPRESSION, kPngCompression};
  std::vector<uint8_t> bytes;
  bool encoded = false;
  std::string reason = "too large for this format";  // the one limit that is left
  try {
    encoded = cv::imencode(is_jpeg ? ".jpg" : ".png", ToOpenCv(image), bytes, parameters);
  } catch (const cv::Exception& error) {
    reason = error.err;
  }
  if (!encoded) {
    throw Error(ErrorKind::kStageFailed,
                fmt::format("{}: cannot encode {} x {} pixels: {}", path.string(), image.width_px,
                            image.height_px, reason));
  }
  return {bytes.begin(), bytes.end()};
}

}  // namespace stucco
