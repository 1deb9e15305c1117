// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "proxy/scene/ground.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "proxy/scene/planes_in_plan.h"

namespace stucco {
namespace {

constexpr double kCosOfTerrain = 0.94;  // 20 degrees: steeper is a bank or a roof

struct HeightRange {
  double low = 0, high = 0;
};

HeightRange RangeOf(const Samples& samples, const Eigen::Vector3d& up,
                    const std::vector<int>& points) {
  std::vector<double> heights;
  heights.reserve(points.size());
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

// Mean height of the plane's points above another plane.
double HeightAbove(const Samples& samples, const Plane& base, const Plane& plane) {
  double sum = 0;
  for (const int i : plane.points) sum += base.DistanceTo(samples.positions[i]);
  return sum / std::max<double>(1, double(plane.points.size()));
}

// The main ground: much area, at the foot of the scene. -1: none.
int MainGround(const Samples& samples, const Tolerances& tolerances, const Eigen::Vector3d& up,
               const std::vector<Plane>& planes, const std::vector<bool>& lowest) {
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
    if (!lowest[p] || planes[p].area < kFewestAreas * tolerances.min_area) continue;
    const double above = MeanHeight(samples, up, planes[p]) - range.low;
    const double score = planes[p].area * std::exp(-std::max(0.0, above) /
                                                   (0.1 * height + tolerances.level_of_detail));
    if (score <= best) continue;
    best = score;
    main = static_cast<int>(p);
  }
  return main;
}

using HeightAndSample = std::pair<double, int>;

// The samples of the window of one level of detail with most of them. `low` is sorted.
std::vector<int> FullestWindow(const std::vector<HeightAndSample>& low, double level_of_detail) {
  size_t best_first = 0;
  size_t best_count = 0;
  size_t last = 0;
  for (size_t first = 0; first < low.size(); ++first) {
    while (last < low.size() && low[last].first < low[first].first + level_of_detail) ++last;
    if (last - first <= best_count) continue;
    best_count = last - first;
    best_first = first;
  }
  std::vector<int> out;
  out.reserve(best_count);
  for (size_t i = best_first; i < best_first + best_count; ++i) out.push_back(low[i].second);
  return out;
}

}  // namespace

std::vector<int> FindGround(const Samples& samples, const Tolerances& tolerances,
                            const Eigen::Vector3d& up, const std::vector<Plane>& planes) {
  constexpr double kHighestYard = 5;  // levels of detail above the ground next to it
  const PlanesInPlan in_plan(samples, tolerances, up, planes);
  std::vector<bool> lowest(planes.size());
  for (size_t p = 0; p < planes.size(); ++p) {
    lowest[p] = planes[p].normal.dot(up) > kCosOfTerrain && !planes[p].points.empty() &&
                in_plan.IsLowest(static_cast<int>(p));
  }
  std::vector<int> ground;
  const int main = MainGround(samples, tolerances, up, planes, lowest);
  if (main < 0) return ground;
  ground.push_back(main);
  lowest[main] = false;
  // From ground to ground, until nothing more joins on.
  for (size_t next = 0; next < ground.size(); ++next) {
    for (size_t p = 0; p < planes.size(); ++p) {
      if (!lowest[p] || !in_plan.Continues(static_cast<int>(p), ground[next])) continue;
      ground.push_back(static_cast<int>(p));
      lowest[p] = false;
    }
  }
  // Yards and terraces apart from the rest, by their height over the ground next to them.
  const size_t joined = ground.size();
  for (size_t p = 0; p < planes.size(); ++p) {
    if (!lowest[p]) continue;
    const std::span<const int> known(ground.data(), joined);
    const int base = in_plan.Nearest(static_cast<int>(p), known);
    if (HeightAbove(samples, planes[base], planes[p]) < kHighestYard * tolerances.level_of_detail) {
      ground.push_back(static_cast<int>(p));
    }
  }
  std::sort(ground.begin() + 1, ground.end());
  return ground;
}

const Plane* GroundBelow(const Samples& samples, const Eigen::Vector3d& up,
                         std::span<const Plane> ground, const std::vector<Plane>& planes) {
  if (ground.size() < 2) return ground.empty() ? nullptr : &ground.front();
  const auto flat = [&](const Eigen::Vector3d& p) { return Eigen::Vector3d(p - up * up.dot(p)); };
  Eigen::AlignedBox3d box;
  for (const Plane& plane : planes) {
    for (const int i : plane.points) box.extend(flat(samples.positions[i]));
  }
  if (box.isEmpty()) return &ground.front();
  // The plane with most points around the building, in a circle that grows until there are some.
  const Plane* best = &ground.front();
  constexpr size_t kProbes = 100000;
  size_t points = 0;
  for (const Plane& plane : ground) points += plane.points.size();
  const size_t stride = 1 + points / kProbes;
  double radius = 0.75 * box.diagonal().norm() + 1e-9;
  for (int round = 0; round < 8; ++round, radius *= 1.5) {
    size_t most = 0;
    for (const Plane& plane : ground) {
      size_t near = 0;
      for (size_t k = 0; k < plane.points.size(); k += stride) {
        const Eigen::Vector3d p = flat(samples.positions[plane.points[k]]);
        near += (p - box.center()).norm() < radius;
      }
      if (near <= most) continue;
      most = near;
      best = &plane;
    }
    if (most > 0) break;
  }
  return best;
}

std::optional<Plane> FitFloor(const Samples& samples, const Tolerances& tolerances,
                              const Eigen::Vector3d& up) {
  constexpr double kCosOfUp = 0.9;
  constexpr double kCosOfLevel = 0.966;  // 15 degrees
  constexpr double kLowPart = 0.15;      // of the scene's height
  constexpr double kFewestAreas = 10;    // of min_area
  constexpr int kRounds = 3;
  std::vector<int> all(samples.size());
  std::iota(all.begin(), all.end(), 0);
  const HeightRange range = RangeOf(samples, up, all);
  const double limit =
      range.low + std::max(kLowPart * (range.high - range.low), 4 * tolerances.level_of_detail);
  std::vector<HeightAndSample> low;
  for (const int i : all) {
    const double height = up.dot(samples.positions[i]);
    if (samples.normals[i].dot(up) > kCosOfUp && height < limit) low.emplace_back(height, i);
  }
  std::sort(low.begin(), low.end());
  Plane floor;
  floor.normal = up;
  floor.role = PlaneRole::kHorizontal;
  floor.points = FullestWindow(low, tolerances.level_of_detail);
  if (floor.points.size() < 3) return std::nullopt;
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
