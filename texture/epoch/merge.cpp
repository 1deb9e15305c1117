// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "texture/epoch/merge.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <numeric>
#include <opencv2/imgproc.hpp>

#include "texture/painting/fill.h"
#include "texture/painting/patch_fill.h"

namespace stucco {
namespace {

constexpr uint8_t kInpainted = 255;
constexpr int kFillSide = 512;
constexpr uint32_t kFillSeed = 20260102;
constexpr float kFeather_px = 8;  // as wide as the largest shift that alignment corrects

// Distance in texels of each taken texel from the nearest one of the facet that is not.
cv::Mat DistanceInside(std::span<const uint8_t> take, std::span<const uint8_t> mask, int width,
                       int height) {
  cv::Mat not_old(height, width, CV_8U);
  size_t old = 0;
  for (size_t i = 0; i < take.size(); ++i) {
    not_old.data[i] = take[i] != 0 || mask[i] == 0;
    old += not_old.data[i] == 0;
  }
  cv::Mat distance(height, width, CV_32F, cv::Scalar(kFeather_px));
  if (old > 0) cv::distanceTransform(not_old, distance, cv::DIST_L2, cv::DIST_MASK_3);
  return distance;
}

}  // namespace

std::vector<uint8_t> TexelsToTake(FacetChoice choice, const FacetPicture& before,
                                  const FacetPicture& after) {
  assert(choice != FacetChoice::kKept);
  std::vector<uint8_t> take(after.labels.size());
  for (size_t i = 0; i < take.size(); ++i) {
    take[i] = IsPainted(after.labels[i]) &&
              (choice != FacetChoice::kFilled || !IsPainted(before.labels[i]));
  }
  return take;
}

FacetPicture MergePictures(const FacetPicture& before, const FacetPicture& after,
                           std::span<const uint8_t> take, std::span<const uint8_t> mask,
                           size_t new_photos) {
  assert(before.labels.size() == take.size() && after.labels.size() == take.size());
  const int width = before.picture.width_px;
  const cv::Mat distance = DistanceInside(take, mask, width, before.picture.height_px);
  FacetPicture merged = before;
  std::vector<uint8_t> known(take.size());
  for (size_t i = 0; i < take.size(); ++i) {
    const uint8_t old = before.labels[i];
    known[i] = mask[i] != 0;
    if (!take[i]) {
      const size_t number = old + new_photos;
      merged.labels[i] = IsPainted(old) && number < kInpainted ? static_cast<uint8_t>(number)
                         : old != 0                            ? kInpainted
                                                               : uint8_t{0};
      continue;
    }
    merged.labels[i] = after.labels[i];
    // Nothing goes over from where the old picture shows nothing.
    const float away = distance.at<float>(static_cast<int>(i / width), static_cast<int>(i % width));
    const float share = old == 0 ? 1 : std::min(1.0f, away / kFeather_px);
    for (size_t k = 3 * i; k < 3 * i + 3; ++k) {
      const float mixed = share * static_cast<float>(after.picture.data[k]) +
                          (1 - share) * static_cast<float>(before.picture.data[k]);
      merged.picture.data[k] = static_cast<uint8_t>(std::lround(mixed));
    }
  }
  FillPictureSmoothly(merged.picture, known);
  return merged;
}

void FillOutdated(std::span<const uint8_t> hole, std::span<const uint8_t> source,
                  FacetPicture& picture) {
  const std::vector<uint8_t> holes(hole.begin(), hole.end());
  std::vector<uint8_t> known(hole.size());
  for (size_t i = 0; i < known.size(); ++i) known[i] = holes[i] == 0;
  FillPictureSmoothly(picture.picture, known);
  FillWithPatches(picture.picture, holes, {source.begin(), source.end()}, kFillSide, kFillSeed);
  for (size_t i = 0; i < holes.size(); ++i) {
    if (holes[i]) picture.labels[i] = kInpainted;
  }
}

std::vector<int> Renumber(std::vector<uint8_t>& labels) {
  std::array<size_t, 256> count = {};
  for (const uint8_t label : labels) ++count[label];
  std::vector<int> order;
  for (int label = 1; label < kInpainted; ++label) {
    if (count[label] > 0) order.push_back(label);
  }
  std::ranges::stable_sort(order, std::greater{}, [&](int label) { return count[label]; });
  std::array<uint8_t, 256> number = {};
  number[kInpainted] = kInpainted;
  for (size_t i = 0; i < order.size(); ++i) number[order[i]] = static_cast<uint8_t>(i + 1);
  for (uint8_t& label : labels) label = number[label];
  for (int& label : order) --label;
  return order;
}

}  // namespace stucco
