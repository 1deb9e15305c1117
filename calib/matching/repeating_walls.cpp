// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/repeating_walls.h"

#include <Eigen/Core>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>
#include <set>
#include <utility>
#include <vector>

#include "calib/features/best_two.h"
#include "calib/features/descriptors.h"
#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr size_t kLeastKeypoints = 100;
// Photos of a wall that are looked at.
constexpr size_t kPhotosOfWall = 8;
constexpr double kLeastShift_m = 1;  // nearer, blobs of one thing overlap
constexpr double kMostShift_m = 10;
constexpr double kLikeSize = 2;
// One place in two photos differs by 0.25 to 0.35 at the median.
constexpr double kTwinAngle_rad = 0.2;
constexpr double kSameShift_m = 0.25;
constexpr int kLeastInCommon = 6;
// Of the keypoints of a wall. Generated towns whose bays differ have up to 0.04 but for two walls
// in a hundred, those without a difference 0.1 to 0.6.
constexpr double kRepeating = 0.1;
// A keypoint belongs to a wall this far beyond its edges too, and where something known stands no
// farther before it.
constexpr double kBeyond_m = 1;

Eigen::Vector3d PointAt(const PlannedFacade& wall, const OnWall& place) {
  const Eigen::Vector2d level = wall.a_m + place.along_m * wall.along();
  return {level.x(), level.y(), place.z_m};
}

// The keypoint's nearest like in the same picture: how far off, upwards or along the wall.
struct Twin {
  double angle_rad = std::numbers::pi;
  Eigen::Vector2d shift_m = Eigen::Vector2d::Zero();
};

// Of a shift and its opposite the one that leads along the wall.
Eigen::Vector2d Forwards(const Eigen::Vector2d& shift) {
  const bool backwards = std::abs(shift.x()) > kSameShift_m ? shift.x() < 0 : shift.y() < 0;
  return backwards ? Eigen::Vector2d(-shift) : shift;
}

std::vector<Twin> TwinsOf(const WallKeypoints& wall) {
  const int count = static_cast<int>(wall.places.size());
  std::vector<Twin> twins(count);
  std::vector<int32_t> products(count);
  for (int i = 0; i < count; ++i) {
    DotProducts(wall.descriptors.data() + static_cast<size_t>(i) * kDescriptorSize,
                wall.descriptors.data(), count, products.data());
    const OnWall& here = wall.places[i];
    int32_t most = -1;
    for (int k = 0; k < count; ++k) {
      if (products[k] <= most) continue;
      const OnWall& there = wall.places[k];
      const Eigen::Vector2d shift(there.along_m - here.along_m, there.z_m - here.z_m);
      const double apart = shift.lpNorm<Eigen::Infinity>();
      const double size = there.scale_m / here.scale_m;
      if (apart < kLeastShift_m || apart > kMostShift_m || size > kLikeSize || size * kLikeSize < 1)
        continue;
      most = products[k];
      twins[i] = {DescriptorAngle(most), Forwards(shift)};
    }
  }
  std::erase_if(twins, [](const Twin& twin) { return twin.angle_rad > kTwinAngle_rad; });
  return twins;
}

// Those of the walls that the photo should show, ascending.
std::vector<int> WallsShown(const ExpectedViews& views, int photo,
                            const std::map<int, double>& walls) {
  std::set<int> shown;
  for (const int point : views.seen[photo]) {
    const int wall = views.points[point].facade;
    if (walls.contains(wall)) shown.insert(wall);
  }
  return {shown.begin(), shown.end()};
}

bool Covers(const PlannedFacade& wall, const OnWall& place) {
  return place.along_m > -kBeyond_m && place.along_m < wall.length_m() + kBeyond_m &&
         place.z_m > wall.z_m.from_m - kBeyond_m && place.z_m < wall.z_m.to_m + kBeyond_m;
}

// The nearest of the walls that the ray of a keypoint meets; -1 where it meets none, or something
// else long before.
int WallOf(const Keypoint& keypoint, const Camera& camera, const std::vector<WallView>& views,
           const std::vector<int>& walls, const Occluders& site) {
  int nearest = -1;
  double distance_m = std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < walls.size(); ++i) {
    const auto place = PlaceOnWall(keypoint, camera, views[i]);
    if (!place || !Covers(views[i].wall, *place)) continue;
    const double apart = (PointAt(views[i].wall, *place) - views[i].cam_from_plan.Center()).norm();
    if (apart >= distance_m) continue;
    distance_m = apart;
    nearest = walls[i];
  }
  if (nearest < 0) return -1;
  const auto ray = camera.Unproject({keypoint.x, keypoint.y});
  const Pose& pose = views.front().cam_from_plan;
  const auto first =
      site.FirstHit(pose.Center(), pose.rotation.conjugate() * ray->homogeneous().normalized());
  return first && *first < distance_m - kBeyond_m ? -1 : nearest;
}

}  // namespace

bool OnRepeatingWalls::IsOnOne(int photo, int keypoint) const {
  if (Shows(photo, keypoint)) return true;
  const auto index = static_cast<size_t>(keypoint);
  return photo < static_cast<int>(rectified.size()) &&
         std::ranges::any_of(rectified[photo], [&](const auto& run) {
           return run.first <= index && index < run.second;
         });
}

bool OnRepeatingWalls::IsMostOf(int photo) const {
  const std::vector<int>& walls = wall_of[photo];
  const auto on_walls = std::ranges::count_if(walls, [](int wall) { return wall >= 0; });
  return on_walls > 0 && 2 * static_cast<size_t>(on_walls) >= walls.size();
}

WallRepeats FindRepeats(const WallKeypoints& wall) {
  const std::vector<Twin> twins = TwinsOf(wall);
  std::vector<int> votes;
  votes.reserve(twins.size());
  for (const Twin& twin : twins) {
    votes.push_back(static_cast<int>(std::ranges::count_if(twins, [&](const Twin& other) {
      return (other.shift_m - twin.shift_m).norm() < kSameShift_m;
    })));
  }
  WallRepeats repeats;
  const auto most = std::ranges::max_element(votes);
  if (most == votes.end() || *most < kLeastInCommon) return repeats;
  const auto in_common =
      std::ranges::count_if(votes, [](int count) { return count >= kLeastInCommon; });
  repeats.share = static_cast<double>(in_common) / static_cast<double>(wall.places.size());
  repeats.period_m = kMostShift_m;
  for (size_t i = 0; i < twins.size(); ++i) {
    // What only a part of a bay has in common is no period.
    if (2 * votes[i] < *most) continue;
    repeats.period_m = std::min(repeats.period_m, twins[i].shift_m.norm());
  }
  return repeats;
}

std::map<int, double> FindRepeatingWalls(const DetectInput& input,
                                         const DetectedFeatures& features) {
  struct Run {
    int photo = 0;
    const WallRun* run = nullptr;
  };
  std::map<int, std::vector<Run>> by_wall;
  for (const auto& [photo_and_wall, run] : features.walls) {
    const auto [photo, wall] = photo_and_wall;
    if (run.places.size() >= kLeastKeypoints) by_wall[wall].push_back({photo, &run});
  }
  std::vector<std::pair<int, std::vector<Run>>> walls(by_wall.begin(), by_wall.end());
  std::vector<double> periods(walls.size(), 0);
  ParallelFor(walls.size(), input.context.threads, [&](size_t i) {
    const int wall = walls[i].first;
    std::vector<Run>& runs = walls[i].second;
    std::ranges::stable_sort(runs, [](const Run& a, const Run& b) {
      return a.run->places.size() > b.run->places.size();
    });
    if (runs.size() > kPhotosOfWall) runs.resize(kPhotosOfWall);
    std::vector<double> shares;
    std::vector<double> of_photos;
    for (const auto& [photo, run] : runs) {
      const WallRepeats repeats =
          FindRepeats({UnitDescriptors(FeaturesOnWall(input, features, photo, wall)), run->places});
      shares.push_back(repeats.share);
      if (repeats.period_m > 0) of_photos.push_back(repeats.period_m);
    }
    if (Median(std::move(shares)).value_or(0) < kRepeating) return;
    periods[i] = Median(std::move(of_photos)).value_or(0);
  });
  std::map<int, double> repeating;
  for (size_t i = 0; i < walls.size(); ++i) {
    if (periods[i] > 0) repeating[walls[i].first] = periods[i];
  }
  return repeating;
}

OnRepeatingWalls FindOnRepeatingWalls(const DetectInput& input, const DetectedFeatures& features) {
  OnRepeatingWalls result;
  result.wall_of.resize(input.set.photos.size());
  result.rectified.resize(input.set.photos.size());
  if (!input.set.guidance.views) return result;
  result.period_m = FindRepeatingWalls(input, features);
  if (result.period_m.empty()) return result;
  for (const auto& [shown, run] : features.walls) {
    if (!result.period_m.contains(shown.second)) continue;
    result.rectified[shown.first].emplace_back(run.begin, run.begin + run.places.size());
  }
  LookAgain(input, features, input.set.guidance.views->poses, result);
  return result;
}

void LookAgain(const DetectInput& input, const DetectedFeatures& features,
               const std::vector<std::optional<Pose>>& poses, OnRepeatingWalls& repeating) {
  const PhotoSet& set = input.set;
  assert(set.guidance.views && poses.size() == set.photos.size());
  const ExpectedViews& views = *set.guidance.views;
  ParallelFor(set.photos.size(), input.context.threads, [&](size_t i) {
    if (!poses[i]) return;
    const std::vector<int> walls = WallsShown(views, static_cast<int>(i), repeating.period_m);
    if (walls.empty()) return;
    std::vector<WallView> of_walls;
    of_walls.reserve(walls.size());
    for (const int wall : walls) {
      of_walls.push_back({set.guidance.facades[wall], {}, {}, *poses[i]});
    }
    const Camera& camera = set.captures.cameras[set.photos[i]->camera].intrinsics;
    std::vector<int>& wall_of = repeating.wall_of[i];
    wall_of.clear();
    for (const Keypoint& k : features.plain[i].keypoints) {
      wall_of.push_back(WallOf(k, camera, of_walls, walls, views.site));
    }
  });
}

}  // namespace stucco
