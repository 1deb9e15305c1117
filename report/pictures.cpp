// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "report/pictures.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>
#include <optional>

#include "survey/escape.h"
#include "survey/image.h"

namespace stucco {
namespace {

constexpr int kThumbnailSide_px = 176;  // shown at half of it, for sharp screens
constexpr uint8_t kOutside = 0;         // labels of textures.json
constexpr uint8_t kInpainted = 255;

// Twelve colours that stay apart for most kinds of colour vision (after Paul Tol's schemes).
constexpr std::array<std::array<uint8_t, 3>, 12> kLabelColors = {{{0x44, 0x77, 0xaa},
                                                                  {0xee, 0x99, 0x33},
                                                                  {0x22, 0x88, 0x33},
                                                                  {0xaa, 0x33, 0x77},
                                                                  {0x66, 0xcc, 0xee},
                                                                  {0xcc, 0xbb, 0x44},
                                                                  {0xee, 0x66, 0x77},
                                                                  {0x33, 0x22, 0x88},
                                                                  {0x44, 0xaa, 0x99},
                                                                  {0x99, 0x99, 0x33},
                                                                  {0x88, 0x22, 0x55},
                                                                  {0x88, 0xcc, 0x88}}};
constexpr uint8_t kInpaintedGrey = 0xb9;
constexpr uint8_t kPaper = 0xe6;  // where a facade's picture is outside its outline

std::optional<Image> Load(const std::filesystem::path& folder, const std::string& name,
                          std::string& problem) {
  if (name.empty()) return std::nullopt;
  std::error_code ignored;
  if (!std::filesystem::exists(folder / name, ignored)) {
    problem = (folder.filename() / name).generic_string() + " is missing";
    return std::nullopt;
  }
  try {
    return ReadImage(folder / name);
  } catch (const std::exception&) {
    problem = (folder.filename() / name).generic_string() + " cannot be read";
    return std::nullopt;
  }
}

cv::Mat AsMatrix(Image& image) {
  return {image.height_px, image.width_px, CV_8UC(image.channels), image.data.data()};
}

cv::Mat Bgr(Image& image) {
  cv::Mat bgr;
  cv::cvtColor(AsMatrix(image), bgr, image.channels == 1 ? cv::COLOR_GRAY2BGR : cv::COLOR_RGB2BGR);
  return bgr;
}

cv::Mat Shrunk(const cv::Mat& picture, int longer_side_px, int interpolation) {
  const ImageSize size = ScaledSize({picture.cols, picture.rows}, longer_side_px);
  if (size.width_px == picture.cols && size.height_px == picture.rows) return picture;
  cv::Mat small;
  cv::resize(picture, small, {size.width_px, size.height_px}, 0, 0, interpolation);
  return small;
}

EmbeddedPicture Embedded(const cv::Mat& picture, const char* extension,
                         const std::vector<int>& parameters) {
  std::vector<uchar> bytes;
  cv::imencode(extension, picture, bytes, parameters);
  const std::string_view view(reinterpret_cast<const char*>(bytes.data()), bytes.size());
  const std::string type = extension == std::string_view(".png") ? "png" : "jpeg";
  return {"data:image/" + type + ";base64," + Base64(view), picture.cols, picture.rows};
}

bool IsLabelMap(const Image& image) {
  return image.channels == 1;
}

// Grey paper where the label map says that a texel is outside the facade.
void BlankOutside(const Image& labels, cv::Mat& picture) {
  if (labels.width_px != picture.cols || labels.height_px != picture.rows) return;
  for (int y = 0; y < picture.rows; ++y) {
    auto* row = picture.ptr<cv::Vec3b>(y);
    for (int x = 0; x < picture.cols; ++x) {
      if (*labels.Pixel(x, y) == kOutside) row[x] = {kPaper, kPaper, kPaper};
    }
  }
}

std::vector<double> PhotoShares(const Image& labels, size_t photos) {
  std::vector<double> counts(photos, 0);
  double painted = 0;
  for (const uint8_t label : labels.data) {
    if (label == kOutside || label == kInpainted || label > photos) continue;
    counts[label - 1] += 1;
    painted += 1;
  }
  for (double& count : counts) count = painted > 0 ? count / painted : 0;
  return counts;
}

// Blue, green, red and alpha of a label.
cv::Vec4b Color(uint8_t label) {
  if (label == kOutside) return {0, 0, 0, 0};
  if (label == kInpainted) return {kInpaintedGrey, kInpaintedGrey, kInpaintedGrey, 255};
  const auto& rgb = kLabelColors[static_cast<size_t>(label - 1) % kLabelColors.size()];
  return {rgb[2], rgb[1], rgb[0], 255};
}

cv::Mat Colored(Image& labels, int longer_side_px) {
  const cv::Mat small = Shrunk(AsMatrix(labels), longer_side_px, cv::INTER_NEAREST);
  cv::Mat colored(small.size(), CV_8UC4);
  for (int y = 0; y < small.rows; ++y) {
    for (int x = 0; x < small.cols; ++x) {
      colored.at<cv::Vec4b>(y, x) = Color(small.at<uint8_t>(y, x));
    }
  }
  return colored;
}

}  // namespace

std::string LabelColor(size_t photo) {
  constexpr std::string_view kHex = "0123456789abcdef";
  std::string color = "#";
  for (const uint8_t channel : kLabelColors[photo % kLabelColors.size()]) {
    color += kHex[channel >> 4];
    color += kHex[channel & 15];
  }
  return color;
}

int PictureSide_px(int wanted_px, size_t count) {
  constexpr double kFullSize = 60;  // pictures of the wanted size make some 10 MB
  if (static_cast<double>(count) <= kFullSize) return wanted_px;
  const double shrunk = wanted_px * std::sqrt(kFullSize / static_cast<double>(count));
  return std::min(wanted_px, std::max(240, static_cast<int>(shrunk)));
}

int PictureThreads(const std::vector<FacetRow>& rows, int threads, uint64_t memory_limit_bytes) {
  // The picture as read and with its channels turned round, and the label map.
  constexpr uint64_t kBytesPerTexel = 3 + 3 + 1;
  uint64_t largest = 1;
  for (const FacetRow& row : rows) {
    if (!row.IsPainted()) continue;
    largest = std::max(largest, kBytesPerTexel * static_cast<uint64_t>(row.texture->width_px) *
                                    static_cast<uint64_t>(row.texture->height_px));
  }
  const uint64_t fit = std::max<uint64_t>(1, memory_limit_bytes / largest);
  return static_cast<int>(std::min<uint64_t>(fit, static_cast<uint64_t>(std::max(1, threads))));
}

EmbeddedPicture MakePicture(const std::filesystem::path& folder, const std::string& name,
                            int picture_px, std::string& problem) {
  auto image = Load(folder, name, problem);
  if (!image) return {};
  return Embedded(Shrunk(Bgr(*image), picture_px, cv::INTER_AREA), ".jpg",
                  {cv::IMWRITE_JPEG_QUALITY, 82});
}

FacetPictures MakeFacetPictures(const FacetRow& row, const std::filesystem::path& texture_folder,
                                int picture_px) {
  FacetPictures pictures;
  if (row.texture == nullptr) return pictures;
  auto labels = Load(texture_folder, row.texture->label_image, pictures.problem);
  if (labels && !IsLabelMap(*labels)) labels.reset();
  auto image = Load(texture_folder, row.texture->image, pictures.problem);
  if (image) {
    cv::Mat picture = Bgr(*image);
    if (labels) BlankOutside(*labels, picture);
    const cv::Mat shown = Shrunk(picture, picture_px, cv::INTER_AREA);
    pictures.texture = Embedded(shown, ".jpg", {cv::IMWRITE_JPEG_QUALITY, 82});
    pictures.thumbnail = Embedded(Shrunk(shown, kThumbnailSide_px, cv::INTER_AREA), ".jpg",
                                  {cv::IMWRITE_JPEG_QUALITY, 78});
  }
  if (labels) {
    pictures.photo_shares = PhotoShares(*labels, row.texture->photos.size());
    const cv::Mat colored = Colored(*labels, std::min(picture_px, 600));
    pictures.labels = Embedded(colored, ".png", {cv::IMWRITE_PNG_COMPRESSION, 9});
  }
  return pictures;
}

}  // namespace stucco
