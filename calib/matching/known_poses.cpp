// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/known_poses.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "calib/records/align_to_map.h"
#include "calib/scene/hovers.h"
#include "survey/median.h"

namespace stucco {
namespace {

// Fewer observations hold no pose surely.
constexpr int kEnoughObservations = 100;
// Of poses that many observations hold.
constexpr double kKnownSigma_m = 0.05;
constexpr double kKnownSigma_rad = 0.1 * std::numbers::pi / 180;

// By photo: many points hold it, and what it shows does not repeat itself.
std::vector<bool> FindWitnesses(const OnRepeatingWalls& repeating, const Scene& scene) {
  std::vector<bool> witnesses(scene.photos.size());
  for (int i = 0; i < static_cast<int>(witnesses.size()); ++i) {
    witnesses[i] = scene.photos[i].pose && !repeating.IsMostOf(i) &&
                   NumUsedObservations(scene, i) >= kEnoughObservations;
  }
  return witnesses;
}

// Points of the photo that witnesses see too.
int NumWitnessed(const Scene& scene, int photo, const std::vector<bool>& witnesses) {
  const std::vector<int> tracks = TracksSeenBy(scene, photo);
  return static_cast<int>(std::ranges::count_if(tracks, [&](int track) {
    return std::ranges::any_of(scene.tracks[track].elements, [&](const SceneElement& e) {
      return e.used && e.photo != photo && witnesses[e.photo];
    });
  }));
}

// By photo: whether its pose is sure.
std::vector<bool> SurelyPosed(const OnRepeatingWalls& repeating, const Scene& scene) {
  const std::vector<bool> witnesses = FindWitnesses(repeating, scene);
  std::vector<bool> surely = witnesses;
  for (int i = 0; i < static_cast<int>(surely.size()); ++i) {
    if (surely[i] || !scene.photos[i].pose) continue;
    surely[i] = NumWitnessed(scene, i, witnesses) >= kEnoughObservations;
  }
  return surely;
}

// The place where photos of the same hover were taken that have sure poses.
struct HoverPlace {
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  double sigma_m = 0;  // per axis, of one more photo
};

std::optional<HoverPlace> PlaceOfHover(const Scene& scene, const std::vector<int>& mates,
                                       const std::vector<bool>& surely) {
  HoverPlace place;
  double count = 0;
  for (const int mate : mates) {
    if (!surely[mate]) continue;
    place.middle += scene.photos[mate].pose->Center();
    ++count;
  }
  if (count == 0 || scene.hover_sigma_m == 0) return std::nullopt;
  place.middle /= count;
  place.sigma_m = std::hypot(kKnownSigma_m, scene.hover_sigma_m * std::sqrt(1 + 1 / count));
  return place;
}

std::optional<KnownPose> KnowPose(const ScenePhoto& photo, bool surely,
                                  const std::optional<HoverPlace>& hover) {
  if (surely) {
    return KnownPose{*photo.pose, {kKnownSigma_m, kKnownSigma_m}, kKnownSigma_rad};
  }
  Eigen::Vector2d recorded_m = Eigen::Vector2d::Constant(std::numeric_limits<double>::infinity());
  if (photo.prior) recorded_m = {photo.prior->sigma_horizontal_m, photo.prior->sigma_vertical_m};
  if (photo.attitude && hover && hover->sigma_m < recorded_m.maxCoeff()) {
    const Eigen::Quaterniond& rotation = photo.attitude->cam_from_world;
    return KnownPose{Pose{rotation, -(rotation * hover->middle)},
                     {hover->sigma_m, hover->sigma_m},
                     photo.attitude->sigma_rad,
                     false};
  }
  const auto recorded = RecordedPose(photo);
  if (!recorded) return std::nullopt;
  return KnownPose{*recorded, recorded_m, photo.attitude->sigma_rad, true};
}

// From the frame of the records into that of the plan: medians, as single records may be wrong.
Eigen::Vector3d PlanFromRecords(const ExpectedViews& views,
                                const std::vector<PoseRecord>& records) {
  std::array<std::vector<double>, 3> offsets;
  for (size_t i = 0; i < records.size(); ++i) {
    if (!views.poses[i] || !records[i].position) continue;
    const Eigen::Vector3d offset = views.poses[i]->Center() - records[i].position->position;
    for (int axis = 0; axis < 3; ++axis) offsets[axis].push_back(offset[axis]);
  }
  Eigen::Vector3d shift;
  for (int axis = 0; axis < 3; ++axis) shift[axis] = Median(std::move(offsets[axis])).value_or(0);
  return shift;
}

}  // namespace

KnownPoses KnowPoses(const KnowInput& input, const Scene& scene) {
  assert(input.guidance.views && input.records.size() == scene.photos.size());
  Eigen::Vector3d plan_from_world = PlanFromRecords(*input.guidance.views, input.records);
  std::vector<Eigen::Vector3d> points;
  for (const SceneTrack& track : scene.tracks) {
    if (track.position) points.push_back(*track.position + plan_from_world);
  }
  const SiteMap map{input.guidance.facades, input.guidance.footprints};
  const auto aligned = AlignToWalls(points, map);
  plan_from_world.head<2>() += aligned ? aligned->shift_m : ShiftOntoMap(points, map);
  const std::vector<bool> surely = SurelyPosed(input.repeating, scene);
  const std::vector<std::vector<int>> mates = HoverMates(scene);
  KnownPoses result;
  result.on_map = aligned.has_value();
  std::vector<std::optional<KnownPose>>& known = result.poses;
  known.resize(scene.photos.size());
  for (size_t i = 0; i < known.size(); ++i) {
    known[i] = KnowPose(scene.photos[i], surely[i], PlaceOfHover(scene, mates[i], surely));
    if (!known[i]) continue;
    Pose& pose = known[i]->cam_from_plan;
    pose = Pose{pose.rotation, -(pose.rotation * (pose.Center() + plan_from_world))};
  }
  return result;
}

}  // namespace stucco
