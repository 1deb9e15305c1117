// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/untold_bays.h"

#include <Eigen/Core>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <map>

#include "calib/mapping/contradicting_groups.h"

namespace stucco {
namespace {

// Fewer points hold nothing (weak_pose.h), nor do they tell a bay.
constexpr int kEnoughPoints = 50;
constexpr int kLeastShared = 30;
constexpr double kLeastShare = 0.2;  // of the points of the photo that sees fewer
constexpr double kLikelier = 0.5;
constexpr double kSure = 0.95;
constexpr std::array<int, 4> kRivals = {-2, -1, 1, 2};  // so many periods off

// Where a photo stands beside its record, along the wall that fills it and upwards.
struct Beside {
  int wall = -1;
  double period_m = 0;
  int num_axes = 1;  // 1: the wall is too low to look the same a period higher
  std::array<double, 2> off_m = {0, 0};
  std::array<double, 2> sigma_m = {1, 1};
};

// Points that hold the photo which are on no such wall and that photos of sure place see too.
int NumTelling(const OnRepeatingWalls& repeating, const Scene& scene, int photo,
               const std::vector<bool>& told) {
  const std::vector<int>& tracks = scene.tracks_of_photo[photo];
  int count = 0;
  for (int keypoint = 0; keypoint < static_cast<int>(tracks.size()); ++keypoint) {
    if (tracks[keypoint] < 0 || repeating.IsOnOne(photo, keypoint)) continue;
    const SceneTrack& track = scene.tracks[tracks[keypoint]];
    bool holds = false;
    bool tells = false;
    for (const SceneElement& e : track.elements) {
      holds = holds || (e.used && e.photo == photo && e.keypoint == keypoint);
      tells = tells || (e.used && told[e.photo]);
    }
    count += track.position && holds && tells;
  }
  return count;
}

// By photo: whether what does not repeat itself tells where it stands.
std::vector<bool> ToldByMatches(const OnRepeatingWalls& repeating, const Scene& scene) {
  const int count = static_cast<int>(scene.photos.size());
  std::vector<bool> told(count, false);
  std::vector<int> open;
  for (int i = 0; i < count; ++i) {
    if (!scene.photos[i].pose) continue;
    told[i] = !repeating.IsMostOf(i) && NumUsedObservations(scene, i) >= kEnoughPoints;
    if (repeating.IsMostOf(i)) open.push_back(i);
  }
  size_t before = open.size() + 1;
  while (open.size() < before) {
    before = open.size();
    std::erase_if(open, [&](int photo) {
      told[photo] = NumTelling(repeating, scene, photo, told) >= kEnoughPoints;
      return told[photo];
    });
  }
  return told;
}

// The wall that most of the photo's keypoints show; -1: none.
int WallThatFills(const OnRepeatingWalls& repeating, int photo) {
  std::map<int, int> keypoints;
  for (const int wall : repeating.wall_of[photo]) {
    if (wall >= 0) ++keypoints[wall];
  }
  const auto most =
      std::ranges::max_element(keypoints, {}, [](const auto& of) { return of.second; });
  return most == keypoints.end() ? -1 : most->first;
}

// Probability that these photos, which stand to each other as they do, are where they are and no
// whole periods beside, by their records alone.
double ChanceOfPlace(const std::vector<const Beside*>& group) {
  const Beside& first = *group.front();
  const double count = static_cast<double>(group.size());
  const double independent = kCommonShare * count + (1 - kCommonShare);
  double rivals = 0;
  for (int axis = 0; axis < first.num_axes; ++axis) {
    for (const int periods : kRivals) {
      const double shift_m = periods * first.period_m;
      double log_odds = 0;
      for (const Beside* photo : group) {
        log_odds += shift_m * (2 * photo->off_m[axis] - shift_m) /
                    (2 * photo->sigma_m[axis] * photo->sigma_m[axis]);
      }
      rivals += std::exp(log_odds / independent);
    }
  }
  return 1 / (1 + rivals);
}

class Judge {
 public:
  Judge(const OnRepeatingWalls& repeating, const std::vector<PlannedFacade>& facades,
        const std::vector<std::optional<PositionPrior>>& recorded, const Scene& scene)
      : scene_(scene) {
    const std::vector<bool> told = ToldByMatches(repeating, scene);
    for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
      if (!scene.photos[i].pose || told[i] || !repeating.IsMostOf(i) || !recorded[i]) continue;
      Beside beside;
      beside.wall = WallThatFills(repeating, i);
      beside.period_m = repeating.period_m.at(beside.wall);
      const PlannedFacade& wall = facades[beside.wall];
      if (wall.z_m.to_m - wall.z_m.from_m >= 2 * beside.period_m) beside.num_axes = 2;
      const Eigen::Vector3d off = scene.photos[i].pose->Center() - recorded[i]->position;
      beside.off_m = {off.head<2>().dot(wall.along()), off.z()};
      beside.sigma_m = {recorded[i]->sigma_horizontal_m, recorded[i]->sigma_vertical_m};
      untold_[i] = beside;
    }
  }

  std::vector<int> Run() {
    std::vector<int> photos;
    for (const auto& [photo, beside] : untold_) {
      if (ChanceOfPlace({&beside}) < kLikelier) photos.push_back(photo);
    }
    for (const int photo : photos) untold_.erase(photo);
    for (const auto& [photo, beside] : untold_) {
      if (ChanceOfPlace(GroupOf(photo, beside)) < kSure) photos.push_back(photo);
    }
    std::ranges::sort(photos);
    return photos;
  }

 private:
  // The photo and those of the same wall that move with it.
  std::vector<const Beside*> GroupOf(int photo, const Beside& beside) const {
    const int points = NumUsedObservations(scene_, photo);
    const std::vector<int> shared = PointsShared(scene_, photo);
    std::vector<const Beside*> group = {&beside};
    for (const auto& [other, of_other] : untold_) {
      if (of_other.wall != beside.wall || shared[other] < kLeastShared) continue;
      const int fewer = std::min(points, NumUsedObservations(scene_, other));
      if (shared[other] >= kLeastShare * fewer) group.push_back(&of_other);
    }
    return group;
  }

  const Scene& scene_;
  std::map<int, Beside> untold_;  // by photo
};

}  // namespace

std::vector<int> UntoldBays(const OnRepeatingWalls& repeating,
                            const std::vector<PlannedFacade>& facades,
                            const std::vector<std::optional<PositionPrior>>& recorded,
                            const Scene& scene) {
  assert(recorded.size() == scene.photos.size());
  assert(repeating.wall_of.size() == scene.photos.size());
  if (repeating.period_m.empty()) return {};
  return Judge(repeating, facades, recorded, scene).Run();
}

}  // namespace stucco
