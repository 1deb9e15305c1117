// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/place_on_walls.h"

#include <Eigen/Core>
#include <algorithm>
#include <limits>
#include <numeric>

#include "calib/matching/which_bay.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

// Of a photo that was placed on a wall, per axis.
constexpr double kPlacedSigma_m = 0.15;
// Walls at the edge of a photo show too little to place it by: these have as much of what the wall
// that fills it has.
constexpr double kOfMost = 0.5;
// A wall in as many steps at the most: each goes on by half a photo or so.
constexpr int kMostSteps = 20;

struct Range {
  double from_m = std::numeric_limits<double>::infinity();
  double to_m = -std::numeric_limits<double>::infinity();
};

Range AlongOf(const WallKeypoints& keypoints) {
  Range range;
  for (const OnWall& at : keypoints.places) {
    range.from_m = std::min<double>(range.from_m, at.along_m);
    range.to_m = std::max<double>(range.to_m, at.along_m);
  }
  return range;
}

class Placing {
 public:
  explicit Placing(const AgainInput& input)
      : set_(input.set),
        context_(input.context),
        poses_(input.poses),
        input_{input.options, input.set, input.features, input.repeating, poses_, input.context},
        shown_(poses_.size()) {}

  std::vector<std::optional<KnownPose>> Run() {
    std::vector<int> all(poses_.size());
    std::iota(all.begin(), all.end(), 0);
    Look(all);
    std::vector<int> open = all;
    std::erase_if(open, [&](int i) { return shown_[i].empty() || !poses_[i]->is_recorded; });
    for (int step = 0; step < kMostSteps && !open.empty(); ++step) {
      const std::vector<int> placed = PlaceAll(open);
      if (placed.empty()) break;
      Look(placed);
      std::erase_if(open, [&](int i) { return std::ranges::binary_search(placed, i); });
    }
    return poses_;
  }

 private:
  void Look(const std::vector<int>& photos) {
    ParallelFor(photos.size(), context_.threads,
                [&](size_t k) { shown_[photos[k]] = ShowWalls(input_, photos[k]); });
  }

  // Those that could be placed, ascending.
  std::vector<int> PlaceAll(const std::vector<int>& open) {
    std::vector<std::optional<Pose>> told(open.size());
    ParallelFor(open.size(), context_.threads, [&](size_t k) {
      context_.ThrowIfCancelled();
      told[k] = Place(open[k]);
    });
    std::vector<int> placed;
    for (size_t k = 0; k < open.size(); ++k) {
      if (!told[k]) continue;
      KnownPose& known = *poses_[open[k]];
      known = {*told[k], {kPlacedSigma_m, kPlacedSigma_m}, known.sigma_rad, false};
      placed.push_back(open[k]);
    }
    return placed;
  }

  std::optional<Pose> Place(int photo) const {
    size_t most = 0;
    for (const auto& [wall, shown] : shown_[photo]) most = std::max(most, shown.of_photo.size());
    for (const auto& [wall, shown] : shown_[photo]) {
      if (shown.of_photo.size() < kOfMost * most) continue;
      if (const auto told = TellOn(photo, wall, shown)) return Moved(photo, wall, *told);
    }
    return std::nullopt;
  }

  std::optional<WallFromWall> TellOn(int photo, int wall, const Shown& shown) const {
    const Eigen::Vector2d sigma_m =
        (PlaceVariances(*poses_[photo], shown.distance_m).array() + kOffWall_m * kOffWall_m).sqrt();
    const std::vector<int> others = OthersOn(wall, shown, sigma_m[0]);
    if (others.empty()) return std::nullopt;
    BayQuestion question{shown.on_wall, {}, sigma_m, [&](const Eigen::Vector2d& place) {
                           return std::ranges::any_of(others, [&](int other) {
                             return ShowsPlace(input_, other, wall, place);
                           });
                         }};
    question.others.reserve(others.size());
    for (const int other : others) question.others.push_back(&shown_[other].at(wall).on_wall);
    return TellBay(question);
  }

  // Photos whose poses are sure, of the same stretch.
  std::vector<int> OthersOn(int wall, const Shown& shown, double sigma_m) const {
    const Range own = AlongOf(shown.on_wall);
    std::vector<int> others;
    for (int i = 0; i < static_cast<int>(shown_.size()); ++i) {
      const auto found = shown_[i].find(wall);
      if (found == shown_[i].end() || poses_[i]->is_recorded) continue;
      const Range range = AlongOf(found->second.on_wall);
      if (range.from_m < own.to_m + sigma_m && range.to_m > own.from_m - sigma_m) {
        others.push_back(i);
      }
    }
    return others;
  }

  // The pose, with the same angles, that puts what the photo shows where it was told to be: places
  // scale about the foot of the camera on the wall as its distance does.
  Pose Moved(int photo, int wall, const WallFromWall& told) const {
    const PlannedFacade& facade = set_.guidance.facades[wall];
    const Pose& pose = poses_[photo]->cam_from_plan;
    const Eigen::Vector3d center = pose.Center();
    const Eigen::Vector2d from_a = center.head<2>() - facade.a_m;
    const Eigen::Vector3d foot(from_a.dot(facade.along()), center.z(), 1);
    const Eigen::Vector2d moved = told * foot;
    const Eigen::Vector2d level = facade.a_m + moved.x() * facade.along() +
                                  told(0, 0) * from_a.dot(facade.outwards()) * facade.outwards();
    return {pose.rotation, -(pose.rotation * Eigen::Vector3d(level.x(), level.y(), moved.y()))};
  }

  const PhotoSet& set_;
  const StageContext& context_;
  std::vector<std::optional<KnownPose>> poses_;
  const AgainInput input_;
  std::vector<ShownWalls> shown_;  // by photo
};

}  // namespace

std::vector<std::optional<KnownPose>> PlaceOnWalls(const AgainInput& input) {
  return Placing(input).Run();
}

}  // namespace stucco
