// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/changed_places.h"

#include <algorithm>
#include <cassert>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

constexpr double kWorthShowing_m2 = 0.1;
constexpr size_t kMostPlaces = 8;
constexpr int kLongestSide_px = 640;
constexpr double kPaper = 0xe6;

// Grey paper outside of the facet.
Image CutOut(const FacetPicture& facet, const cv::Rect& part) {
  const Image& image = facet.picture;
  const cv::Mat rgb(image.height_px, image.width_px, CV_8UC3,
                    const_cast<uint8_t*>(image.data.data()));
  const cv::Mat labels(image.height_px, image.width_px, CV_8U,
                       const_cast<uint8_t*>(facet.labels.data()));
  cv::Mat shown = rgb(part).clone();
  shown.setTo(cv::Scalar::all(kPaper), labels(part) == 0);
  const double scale = static_cast<double>(kLongestSide_px) / std::max(part.width, part.height);
  if (scale < 1) cv::resize(shown, shown, {}, scale, scale, cv::INTER_AREA);
  return {shown.cols, shown.rows, 3, {shown.datastart, shown.dataend}};
}

}  // namespace

std::vector<ChangedBox> WorthShowing(std::span<const ChangedBox> boxes, double facet_area) {
  std::vector<ChangedBox> shown;
  for (const ChangedBox& box : boxes) {
    if (shown.size() < kMostPlaces && box.share * facet_area > kWorthShowing_m2) {
      shown.push_back(box);
    }
  }
  return shown;
}

EpochPlace PlaceOf(const ChangedBox& box, const TexelGrid& grid, double facet_area) {
  EpochPlace place;
  place.what = box.pattern ? "pattern" : "colour";
  place.along_m = {box.left * grid.texel, (box.left + box.width) * grid.texel};
  place.up_m = {(grid.height - box.top - box.height) * grid.texel,
                (grid.height - box.top) * grid.texel};
  place.area_m2 = box.share * facet_area;
  return place;
}

PlacePictures ShowPlace(const ChangedBox& box, const FacetPicture& before,
                        const FacetPicture& after) {
  const int margin = std::max(box.width, box.height) / 2;
  const cv::Rect part = cv::Rect(box.left - margin, box.top - margin, box.width + 2 * margin,
                                 box.height + 2 * margin) &
                        cv::Rect(0, 0, before.picture.width_px, before.picture.height_px);
  assert(!part.empty() && after.picture.data.size() == before.picture.data.size());
  return {CutOut(before, part), CutOut(after, part)};
}

}  // namespace stucco
