// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/image.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstring>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "survey/encode_image.h"
#include "survey/error.h"
#include "survey/files.h"
#include "survey/internal/decode.h"
#include "survey/internal/jpeg.h"

namespace stucco {
namespace {

std::string LowerCaseExtension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  for (char& c : extension) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return extension;
}

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
  const cv::Mat pixels(image.height_px, image.width_px, CV_8UC(image.channels),
                       const_cast<uint8_t*>(image.data.data()));
  if (image.channels == 1) return pixels;
  cv::Mat bgr;
  cv::cvtColor(pixels, bgr, cv::COLOR_RGB2BGR);
  return bgr;
}

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

ImageSize ScaledSize(ImageSize full, int max_side_px) {
  const int longer = std::max(full.width_px, full.height_px);
  if (max_side_px <= 0 || longer <= max_side_px) return full;
  const auto scaled = [&](int side) {
    const int64_t rounded = (int64_t{side} * max_side_px + longer / 2) / longer;
    return std::max(1, static_cast<int>(rounded));
  };
  return {scaled(full.width_px), scaled(full.height_px)};
}

std::string EncodeImage(const Image& image, const std::filesystem::path& path, int quality) {
  CheckIsWhole(image, path);
  const std::string extension = LowerCaseExtension(path);
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
