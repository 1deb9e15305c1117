// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/output/explain.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <string>
#include <vector>

namespace stucco {
namespace {

constexpr int kPerRow = 4;
constexpr int kCell_px = 300;  // longer side of a candidate's picture
constexpr int kMargin_px = 8;
constexpr int kFrame_px = 4;
constexpr int kCaption_px = 18;
constexpr int kOwnerSide_px = 1600;

const cv::Scalar kPaper(255, 255, 255);
const cv::Scalar kInk(40, 40, 40);

// Colours that differ as much from each other as they can, however many there are: hues by the
// golden angle.
cv::Vec3b ColourOf(int candidate) {
  const double hue = std::fmod(candidate * 137.50776, 360) / 2;  // OpenCV counts half degrees
  const cv::Mat3b hsv(1, 1, cv::Vec3b(static_cast<uint8_t>(hue), 200, 230));
  cv::Mat3b rgb;
  cv::cvtColor(hsv, rgb, cv::COLOR_HSV2RGB);
  return rgb(0, 0);
}

Image ToImage(const cv::Mat& rgb) {
  const cv::Mat whole = rgb.isContinuous() ? rgb : rgb.clone();
  return {whole.cols, whole.rows, 3, {whole.data, whole.data + whole.total() * 3}};
}

cv::Mat Wrap(const Image& image) {
  return {image.height_px, image.width_px, CV_8UC3, const_cast<uint8_t*>(image.data.data())};
}

// Enlarged without smoothing, or reduced, so that the longer side is `side` pixels.
cv::Mat Fitted(const cv::Mat& picture, int side) {
  const double scale = static_cast<double>(side) / std::max(picture.cols, picture.rows);
  const cv::Size size(std::max(1, static_cast<int>(std::lround(picture.cols * scale))),
                      std::max(1, static_cast<int>(std::lround(picture.rows * scale))));
  cv::Mat fitted;
  cv::resize(picture, fitted, size, 0, 0, scale < 1 ? cv::INTER_AREA : cv::INTER_NEAREST);
  return fitted;
}

cv::Vec3b Mixed(const cv::Vec3b& colour, const cv::Vec3b& tint) {
  cv::Vec3b mixed;
  for (int k = 0; k < 3; ++k) mixed[k] = static_cast<uint8_t>((colour[k] + tint[k]) / 2);
  return mixed;
}

cv::Mat WhatItShows(const RasterPicture& picture, const FacetRaster& raster) {
  cv::Mat shown(raster.grid.height, raster.grid.width, CV_8UC3, kPaper);
  for (size_t i = 0; i < raster.grid.size(); ++i) {
    if (raster.inside[i] == 0 || picture.sight[i] == Sight::kNot) continue;
    cv::Vec3b colour;
    for (int k = 0; k < 3; ++k) {
      colour[k] = cv::saturate_cast<uint8_t>(picture.rgb[3 * i + static_cast<size_t>(k)]);
    }
    if (picture.sight[i] == Sight::kBehind) colour = Mixed(colour, {255, 0, 0});
    if (picture.sight[i] == Sight::kBeyond) colour = Mixed(colour, {0, 80, 255});
    shown.at<cv::Vec3b>(static_cast<int>(i) / raster.grid.width,
                        static_cast<int>(i) % raster.grid.width) = colour;
  }
  return shown;
}

// Of the raster that somebody paints, by candidate.
std::vector<double> SharesOf(const PaintRecord& record) {
  std::vector<double> shares(record.photos.size(), 0);
  double total = 0;
  for (size_t i = 0; i < record.owner.size(); ++i) {
    total += record.raster.inside[i];
    if (record.owner[i] >= 0) shares[record.owner[i]] += record.raster.inside[i];
  }
  for (double& share : shares) share /= std::max(1.0, total);
  return shares;
}

void Write(cv::Mat& sheet, const std::string& text, cv::Point at) {
  cv::putText(sheet, text, at, cv::FONT_HERSHEY_SIMPLEX, 0.4, kInk, 1, cv::LINE_AA);
}

}  // namespace

Image CandidateSheet(const PaintRecord& record, std::span<const SurveyPhoto> photos) {
  const std::vector<double> shares = SharesOf(record);
  constexpr int kWide = kCell_px + 2 * kMargin_px;
  constexpr int kHigh = kWide + kCaption_px;
  const int count = static_cast<int>(record.photos.size());
  const int rows = std::max(1, (count + kPerRow - 1) / kPerRow);
  cv::Mat sheet(rows * kHigh, kPerRow * kWide, CV_8UC3, kPaper);
  for (int c = 0; c < count; ++c) {
    const cv::Point corner(c % kPerRow * kWide + kMargin_px, c / kPerRow * kHigh + kMargin_px);
    const cv::Mat picture = Fitted(WhatItShows(record.pictures[c], record.raster), kCell_px);
    const cv::Rect place(corner, picture.size());
    picture.copyTo(sheet(place));
    if (shares[c] > 0) {
      const cv::Rect around(place.x - kFrame_px, place.y - kFrame_px, place.width + 2 * kFrame_px,
                            place.height + 2 * kFrame_px);
      cv::rectangle(sheet, around, cv::Scalar(ColourOf(c)), kFrame_px);
    }
    const std::string name = photos[record.photos[c]].path();
    constexpr size_t kMostLetters = 34;
    Write(sheet,
          fmt::format("{:.0f} % {}", 100 * shares[c],
                      name.substr(name.size() - std::min(name.size(), kMostLetters))),
          {corner.x, corner.y + kCell_px + kCaption_px});
  }
  return ToImage(sheet);
}

Image OwnerMap(const PaintRecord& record) {
  const TexelGrid& grid = record.raster.grid;
  cv::Mat map(grid.height, grid.width, CV_8UC3, kPaper);
  const auto owner = [&](int x, int y) {
    return record.owner[static_cast<size_t>(y) * grid.width + x];
  };
  for (int y = 0; y < grid.height; ++y) {
    for (int x = 0; x < grid.width; ++x) {
      const int own = owner(x, y);
      if (own < 0) continue;
      const size_t i = static_cast<size_t>(y) * grid.width + x;
      const float* rgb = &record.pictures[own].rgb[3 * i];
      const auto grey = cv::saturate_cast<uint8_t>((rgb[0] + rgb[1] + rgb[2]) / 3);
      const bool seam = (x > 0 && owner(x - 1, y) != own) || (y > 0 && owner(x, y - 1) != own);
      map.at<cv::Vec3b>(y, x) =
          seam ? cv::Vec3b(0, 0, 0) : Mixed({grey, grey, grey}, ColourOf(own));
    }
  }
  return ToImage(std::max(grid.width, grid.height) < kOwnerSide_px ? Fitted(map, kOwnerSide_px)
                                                                   : map);
}

Image BeforeAndAfterLight(const PaintRecord& record, const PaintedFacet& painted) {
  const int side = std::min(kLightSide_px, std::max(painted.grid.width, painted.grid.height));
  const cv::Mat before = Fitted(Wrap(record.unlit), side);
  const cv::Mat after = Fitted(Wrap(painted.picture), side);
  cv::Mat both;
  cv::hconcat(
      std::vector<cv::Mat>{before, cv::Mat(before.rows, kMargin_px, CV_8UC3, kPaper), after}, both);
  return ToImage(both);
}

Image ReliefMap(const PaintedFacet& painted) {
  if (!painted.grid.relief) return {};
  const Relief& relief = *painted.grid.relief;
  float highest = 0;
  for (const float height : relief.heights) highest = std::max(highest, std::abs(height));
  cv::Mat map(relief.height, relief.width, CV_8UC3, kPaper);
  for (size_t i = 0; i < relief.heights.size(); ++i) {
    if (relief.heights[i] == 0) continue;
    const auto faded =
        static_cast<uint8_t>(std::lround(200 * (1 - std::abs(relief.heights[i]) / highest)));
    map.at<cv::Vec3b>(static_cast<int>(i) / relief.width, static_cast<int>(i) % relief.width) =
        relief.heights[i] > 0 ? cv::Vec3b(255, faded, faded) : cv::Vec3b(faded, faded, 255);
  }
  const cv::Mat picture = Fitted(map, kOwnerSide_px);
  cv::Mat sheet(picture.rows + kCaption_px + kMargin_px, picture.cols, CV_8UC3, kPaper);
  picture.copyTo(sheet(cv::Rect(0, 0, picture.cols, picture.rows)));
  Write(sheet, fmt::format("red: before the plane, blue: behind, full colour {:.2f}", highest),
        {kMargin_px, picture.rows + kCaption_px});
  return ToImage(sheet);
}

void WriteExplanation(const PaintRecord& record, const PaintedFacet& painted,
                      std::span<const SurveyPhoto> photos, const std::filesystem::path& folder) {
  if (record.photos.empty() || painted.picture.data.empty()) return;
  std::filesystem::create_directories(folder);
  WriteImage(CandidateSheet(record, photos), folder / "candidates.jpg");
  WriteImage(OwnerMap(record), folder / "owners.png");
  WriteImage(BeforeAndAfterLight(record, painted), folder / "light.jpg");
  if (painted.grid.relief) WriteImage(ReliefMap(painted), folder / "relief.png");
}

}  // namespace stucco
