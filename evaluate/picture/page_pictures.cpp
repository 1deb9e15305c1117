// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "evaluate/picture/page_pictures.h"

#include <fmt/format.h>

#include <cctype>
#include <opencv2/imgproc.hpp>
#include <regex>
#include <system_error>

#include "evaluate/picture/internal/planes.h"

namespace stucco::evaluate {
namespace {

constexpr int kLongestSide_px = 1400;
constexpr int kJpegQuality = 88;
constexpr uint8_t kPaper = 0x80;  // as in FLIP's map

Image Blanked(const Image& image, const std::vector<uint8_t>& mask) {
  Image blanked = image;
  for (size_t i = 0; i < mask.size(); ++i) {
    if (mask[i] == 0) std::fill_n(&blanked.data[3 * i], 3, kPaper);
  }
  return blanked;
}

Image Shrunk(const Image& image) {
  const ImageSize size = ScaledSize({image.width_px, image.height_px}, kLongestSide_px);
  if (size.width_px == image.width_px && size.height_px == image.height_px) return image;
  Image small{size.width_px, size.height_px, 3, {}};
  small.data.resize(size_t{3} * size.width_px * size.height_px);
  cv::Mat pixels(size.height_px, size.width_px, CV_8UC3, small.data.data());
  cv::resize(internal::Rgb(image), pixels, pixels.size(), 0, 0, cv::INTER_AREA);
  return small;
}

}  // namespace

std::string PictureStem(size_t number, std::string_view id) {
  std::string stem = fmt::format("pictures/{:04}-", number);
  for (const char c : id.substr(0, 60)) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain = byte < 0x80 && (std::isalnum(byte) != 0 || c == '-');
    stem += plain ? c : '_';
  }
  return stem;
}

void RemovePagePictures(const std::filesystem::path& output) {
  static const std::regex kOurs("[0-9]{4,}-.*-(truth|result|error)\\.jpg");
  std::error_code error;
  for (const auto& entry : std::filesystem::directory_iterator(output / "pictures", error)) {
    if (std::regex_match(entry.path().filename().string(), kOurs)) {
      std::filesystem::remove(entry.path(), error);
    }
  }
}

PagePictures WritePagePictures(const PicturePair& pair, const FlipMap& flip,
                               const std::filesystem::path& output, const std::string& stem) {
  std::filesystem::create_directories(output / "pictures");
  PagePictures names{stem + "-truth.jpg", stem + "-result.jpg", stem + "-error.jpg"};
  WriteImage(Shrunk(Blanked(pair.truth, pair.mask)), output / names.truth, kJpegQuality);
  WriteImage(Shrunk(Blanked(pair.result, pair.mask)), output / names.result, kJpegQuality);
  WriteImage(Shrunk(Coloured(flip)), output / names.error, kJpegQuality);
  return names;
}

}  // namespace stucco::evaluate
