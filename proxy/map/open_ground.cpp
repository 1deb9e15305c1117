// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/open_ground.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

namespace stucco {
namespace {

constexpr double kEaves_m = 1;

cv::Mat Disc(double width_m, double cell) {
  const int size = 2 * static_cast<int>(width_m / cell / 2) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
}

// Cells in which the ground shows and nothing lies above it.
cv::Mat ShownGround(const RoofEvidence& evidence, const PlaneRaster& raster) {
  constexpr double kGap_m = 0.6;
  constexpr double kNarrowest_m = 1.2;
  cv::Mat open = cv::Mat::zeros(raster.height, raster.width, CV_8U);
  const auto mark = [&](const Eigen::Vector2d& p, uint8_t value) {
    const int at = raster.IndexAt(p);
    if (at >= 0) open.at<uint8_t>(at / raster.width, at % raster.width) = value;
  };
  for (const Eigen::Vector2d& p : evidence.open) mark(p, 255);
  cv::morphologyEx(open, open, cv::MORPH_CLOSE, Disc(kGap_m, raster.cell));
  for (const auto& p : evidence.samples.positions) mark(p.head<2>(), 0);
  cv::morphologyEx(open, open, cv::MORPH_OPEN, Disc(kNarrowest_m, raster.cell));
  return open;
}

// Its patches that are large enough, by cells; empty without any.
std::vector<char> LargePatches(const cv::Mat& open, double cell) {
  constexpr double kLeast_m2 = 3;
  cv::Mat patches, figures, middles;
  const int count = cv::connectedComponentsWithStats(open, patches, figures, middles);
  std::vector<char> is_large(count, 0);
  for (int patch = 1; patch < count; ++patch) {
    const double area_m2 = figures.at<int>(patch, cv::CC_STAT_AREA) * cell * cell;
    is_large[patch] = area_m2 < kLeast_m2 ? 0 : 1;
  }
  if (std::ranges::find(is_large, 1) == is_large.end()) return {};
  std::vector<char> large;
  large.reserve(patches.total());
  for (int y = 0; y < patches.rows; ++y) {
    for (int x = 0; x < patches.cols; ++x) large.push_back(is_large[patches.at<int>(y, x)]);
  }
  return large;
}

double DistanceBefore(const Plane& step, const Eigen::Vector2d& p) {
  return step.normal.head<2>().dot(p) - step.offset;
}

// Whether a place lies close in front of an upright plane above the footprint, and behind none. Of
// planes that look the same way the largest says so: the wall, not its balconies.
bool IsBeforeWall(const RoofEvidence& evidence, const Eigen::Vector2d& p) {
  constexpr double kSameWay = 0.9;
  std::vector<const Plane*> near;
  for (const Plane& step : evidence.steps) {
    if (std::abs(DistanceBefore(step, p)) <= kEaves_m) near.push_back(&step);
  }
  std::erase_if(near, [&, all = near](const Plane* step) {
    return std::ranges::any_of(all, [&](const Plane* other) {
      return other->area > step->area && other->normal.dot(step->normal) > kSameWay;
    });
  });
  return !near.empty() && std::ranges::all_of(near, [&](const Plane* step) {
    return DistanceBefore(*step, p) >= 0;
  });
}

}  // namespace

std::vector<float> DistancesToOpenGround(const RoofEvidence& evidence, const PlaneRaster& raster) {
  std::vector<char> open = LargePatches(ShownGround(evidence, raster), raster.cell);
  if (open.empty()) return {};
  const std::vector<float> to_patches = DistancesTo(raster, open);
  for (size_t at = 0; at < open.size(); ++at) {
    const int x = static_cast<int>(at) % raster.width, y = static_cast<int>(at) / raster.width;
    const bool near = to_patches[at] < kEaves_m;
    if (near && IsBeforeWall(evidence, raster.Center(x, y))) open[at] = 1;
  }
  return DistancesTo(raster, open);
}

}  // namespace stucco
