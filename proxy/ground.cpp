// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/ground.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace stucco {
namespace {

constexpr double kCosOfLevel = 0.966;  // 15 degrees

struct HeightRange {
  double low = 0, high = 0;
};

HeightRange RangeOf(const Samples& samples, const Eigen::Vector3d& up,
                    const std::vector<int>& points) {
  std::vector<double> heights;
  for (const int i : points) heights.push_back(up.dot(samples.positions[i]));
  if (heights.empty()) return {};
  std::sort(heights.begin(), heights.end());
  const size_t low = heights.size() / 50;
  return {heights[low], heights[heights.size() - 1 - low]};
}

double MeanHeight(const Samples& samples, const Eigen::Vector3d& up, const Plane& plane) {
  double sum = 0;
  for (const int i : plane.points) sum += up.dot(samples.positions[i]);
  return sum / std::max<double>(1, double(plane.points.size()));
}

// Mean height of the points above the main ground's plane.
double HeightAbove(const Samples& samples, const Plane& main, const Plane& plane) {
  double sum = 0;
  for (const int i : plane.points) sum += main.DistanceTo(samples.positions[i]);
  return sum / std::max<double>(1, double(plane.points.size()));
}

}  // namespace

std::vector<int> FindGround(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, const std::vector<Plane>& planes) {
  constexpr double kLowPart = 0.3;     // of the scene's height: higher is a roof
  constexpr double kTerrace = 0.1;     // of the scene's height above the main ground
  constexpr double kFewestAreas = 10;  // of min_area
  std::vector<int> all;
  for (const Plane& plane : planes) {
    all.insert(all.end(), plane.points.begin(), plane.points.end());
  }
  const HeightRange range = RangeOf(samples, up, all);
  const double height = range.high - range.low;
  int main = -1;
  double best = 0;
  for (size_t p = 0; p < planes.size(); ++p) {
    if (planes[p].normal.dot(up) < kCosOfLevel) continue;
    if (planes[p].area < kFewestAreas * tolerances.min_area) continue;
    const double above = MeanHeight(samples, up, planes[p]) - range.low;
    if (above > kLowPart * height + 2 * tolerances.level_of_detail) continue;
    const double score = planes[p].area * std::exp(-std::max(0.0, above) /
                                                   (0.1 * height + tolerances.level_of_detail));
    if (score <= best) continue;
    best = score;
    main = static_cast<int>(p);
  }
  std::vector<int> ground;
  if (main < 0) return ground;
  ground.push_back(main);
  for (size_t p = 0; p < planes.size(); ++p) {
    if (static_cast<int>(p) == main || planes[p].normal.dot(up) < kCosOfLevel) continue;
    const double above = HeightAbove(samples, planes[main], planes[p]);
    if (above < std::max(2 * tolerances.level_of_detail, kTerrace * height) &&
        above < 5 * tolerances.level_of_detail) {
      ground.push_back(static_cast<int>(p));
    }
  }
  return ground;
}

std::optional<Plane> FitFloor(const Samples& samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up) {
  constexpr double kCosOfUp = 0.9;
  constexpr double kLowPart = 0.15;    // of the scene's height
  constexpr double kFewestAreas = 10;  // of min_area
  constexpr int kRounds = 3;
  std::vector<int> all(samples.size());
  std::iota(all.begin(), all.end(), 0);
  const HeightRange range = RangeOf(samples, up, all);
  const double limit =
      range.low + std::max(kLowPart * (range.high - range.low), 4 * tolerances.level_of_detail);
  std::vector<std::pair<double, int>> low;  // height, sample
  for (const int i : all) {
    const double height = up.dot(samples.positions[i]);
    if (samples.normals[i].dot(up) > kCosOfUp && height < limit) low.emplace_back(height, i);
  }
  std::sort(low.begin(), low.end());
  // The window of one level of detail with most samples.
  size_t best_first = 0, best_count = 0, last = 0;
  for (size_t first = 0; first < low.size(); ++first) {
    while (last < low.size() && low[last].first < low[first].first + tolerances.level_of_detail) {
      ++last;
    }
    if (last - first <= best_count) continue;
    best_count = last - first;
    best_first = first;
  }
  if (best_count < 3) return std::nullopt;
  Plane floor;
  floor.normal = up;
  floor.role = PlaneRole::kHorizontal;
  for (size_t i = best_first; i < best_first + best_count; ++i) {
    floor.points.push_back(low[i].second);
  }
  for (int round = 0; round < kRounds; ++round) {
    Refit(samples, floor);
    floor.points.clear();
    for (const auto& [height, i] : low) {
      if (std::abs(floor.DistanceTo(samples.positions[i])) <= tolerances.epsilon) {
        floor.points.push_back(i);
      }
    }
    if (floor.points.size() < 3) return std::nullopt;
  }
  std::sort(floor.points.begin(), floor.points.end());
  Measure(samples, 2.5 * tolerances.spacing, floor);
  const bool level = floor.normal.dot(up) > kCosOfLevel;
  if (!level || floor.area < kFewestAreas * tolerances.min_area) return std::nullopt;
  return floor;
}

}  // namespace stucco
