// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/map/open_ground.h"

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>

#include "proxy/map/sight_lines.h"

namespace stucco {
namespace {

constexpr double kEaves_m = 1;

cv::Mat Disc(double width_m, double cell) {
  const int size = 2 * static_cast<int>(width_m / cell / 2) + 1;
  return cv::getStructuringElement(cv::MORPH_ELLIPSE, {size, size});
}

// Cells in which the ground shows and nothing lies above it, or `through` which photos look.
cv::Mat ShownGround(const RoofEvidence& evidence, const PlaneRaster& raster,
                    const std::vector<char>& through) {
  constexpr double kGap_m = 0.6;
  constexpr double kNarrowest_m = 1.2;
  cv::Mat open = cv::Mat::zeros(raster.height, raster.width, CV_8U);
  const auto mark = [&](const Eigen::Vector2d& p, uint8_t value) {
    const int at = raster.IndexAt(p);
    if (at >= 0) open.at<uint8_t>(at / raster.width, at % raster.width) = value;
  };
  for (const Eigen::Vector2d& p : evidence.open) mark(p, 255);
  for (size_t at = 0; at < through.size(); ++at) {
    if (through[at] != 0) open.data[at] = 255;
  }
  cv::morphologyEx(open, open, cv::MORPH_CLOSE, Disc(kGap_m, raster.cell));
  for (const auto& p : evidence.samples.positions) {
    const int at = raster.IndexAt(p.head<2>());
    if (at >= 0 && through[at] == 0) open.data[at] = 0;
  }
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

constexpr double kSameWay = 0.9;  // cosine

// Whether a place lies close in front of an upright plane above the footprint, and behind none. Of
// planes that look the same way the largest says so: the wall, not its balconies.
bool IsBeforeWall(const RoofEvidence& evidence, const Eigen::Vector2d& p) {
  std::vector<const RoofStep*> near;
  for (const RoofStep& step : evidence.steps) {
    if (std::abs(step.Before(p)) <= kEaves_m) near.push_back(&step);
  }
  std::erase_if(near, [&, all = near](const RoofStep* step) {
    return std::ranges::any_of(all, [&](const RoofStep* other) {
      return other->plane.area > step->plane.area &&
             other->plane.normal.dot(step->plane.normal) > kSameWay;
    });
  });
  return !near.empty() &&
         std::ranges::all_of(near, [&](const RoofStep* step) { return step->Before(p) >= 0; });
}

// What nobody saw between a wall and the open ground before it: walls and what stands at them hide
// the foot of a wall from above.
class HiddenFoot {
 public:
  HiddenFoot(const RoofEvidence& evidence, const PlaneRaster& raster, const std::vector<char>& open)
      : raster_(raster), open_(open), walls_(MainWalls(evidence.steps)), covered_(open.size(), 0) {
    for (const Eigen::Vector3d& p : evidence.samples.positions) {
      const int at = raster.IndexAt(p.head<2>());
      if (at >= 0 && open[at] == 0) covered_[at] = 1;
    }
  }

  bool Holds(const Eigen::Vector2d& p) const {
    return std::ranges::any_of(walls_, [&](const RoofStep* wall) {
      const double before = wall->Before(p);
      return before > 0 && before < kReach_m && wall->Faces(p) && IsBare(*wall, p, before) &&
             LeadsToOpenGround(*wall, p, before);
    });
  }

 private:
  static constexpr double kReach_m = 3;

  // All the way to the wall, but for its eaves.
  bool IsBare(const RoofStep& step, const Eigen::Vector2d& p, double before) const {
    for (double back = 0; before - back > kEaves_m; back += raster_.cell) {
      const int at = raster_.IndexAt(p - back * step.plane.normal.head<2>());
      if (at < 0 || covered_[at] != 0) return false;
    }
    return true;
  }

  bool LeadsToOpenGround(const RoofStep& step, const Eigen::Vector2d& p, double before) const {
    for (double way = raster_.cell; way < kReach_m; way += raster_.cell) {
      const int at = raster_.IndexAt(p + way * step.plane.normal.head<2>());
      if (at < 0) return false;
      if (open_[at] != 0) return true;
      if (before + way > kEaves_m && covered_[at] != 0) return false;
    }
    return false;
  }

  const PlaneRaster& raster_;
  const std::vector<char>& open_;
  std::vector<const RoofStep*> walls_;
  std::vector<char> covered_;
};

}  // namespace

std::vector<float> DistancesToOpenGround(const RoofEvidence& evidence, const PlaneRaster& raster,
                                         const Tolerances& tolerances) {
  const std::vector<char> through = SeenThrough(evidence, raster, tolerances);
  std::vector<char> open = LargePatches(ShownGround(evidence, raster, through), raster.cell);
  if (open.empty()) return {};
  const std::vector<float> to_patches = DistancesTo(raster, open);
  const std::vector<char> patches = open;
  const HiddenFoot hidden(evidence, raster, patches);
  for (size_t at = 0; at < open.size(); ++at) {
    const int x = static_cast<int>(at) % raster.width, y = static_cast<int>(at) / raster.width;
    const Eigen::Vector2d p = raster.Center(x, y);
    const bool near = to_patches[at] < kEaves_m;
    if ((near && IsBeforeWall(evidence, p)) || hidden.Holds(p)) open[at] = 1;
  }
  return DistancesTo(raster, open);
}

}  // namespace stucco
