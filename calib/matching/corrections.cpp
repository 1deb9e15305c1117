// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/corrections.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/scene/resect.h"
#include "calib/scene/tracks.h"

namespace stucco {
namespace {

constexpr int kLeastSightings = 12;
// The points are as wrong as the record of the photo that they come from, and as the map.
constexpr double kPointsOff = 4 * std::numbers::pi / 180;
// Two corrections carry the errors of two records.
constexpr double kAgreeAngle = 12 * std::numbers::pi / 180;
constexpr double kAgree_m = 7;

// A scene of this photo and these points.
Scene SceneOf(const Scene& scene, int photo, std::span<const RecordSighting> sightings) {
  Scene alone;
  alone.cameras = {scene.cameras[scene.photos[photo].camera]};
  ScenePhoto seeing;
  for (const RecordSighting& sighting : sightings) {
    const int index = static_cast<int>(seeing.keypoints.size());
    seeing.keypoints.push_back(scene.photos[photo].keypoints[sighting.keypoint]);
    alone.tracks.push_back({{{0, index, false}}, sighting.point});
  }
  alone.photos.push_back(std::move(seeing));
  IndexTracks(alone);
  return alone;
}

// Judged by where they put the places of both: a turn moves far places more.
bool Agree(const Correction& a, const Correction& b) {
  const Eigen::Quaterniond& turn_a = a.moved_from_recorded.rotation;
  const Eigen::Quaterniond& turn_b = b.moved_from_recorded.rotation;
  return turn_a.angularDistance(turn_b) < kAgreeAngle &&
         (a.Moved() - b.moved_from_recorded * a.recorded).norm() < kAgree_m &&
         (b.Moved() - a.moved_from_recorded * b.recorded).norm() < kAgree_m;
}

}  // namespace

std::optional<Correction> ProposeCorrection(const Scene& scene, int photo,
                                            const Pose& recorded_cam_from_plan,
                                            std::span<const RecordSighting> sightings) {
  if (sightings.size() < kLeastSightings) return std::nullopt;
  const Scene alone = SceneOf(scene, photo, sightings);
  const double limit_px = std::tan(kPointsOff) * alone.CameraOf(0).FocalX();
  const auto resection = Resect(alone, 0, limit_px, kLeastSightings);
  if (!resection || 2 * resection->num_inliers < resection->num_points) return std::nullopt;
  return Correction{resection->cam_from_world.Inverse() * recorded_cam_from_plan,
                    recorded_cam_from_plan.Center()};
}

Agreement LargestAgreement(std::span<const Correction> corrections) {
  Agreement largest;
  for (size_t i = 0; i < corrections.size(); ++i) {
    const auto count = std::ranges::count_if(
        corrections, [&](const Correction& other) { return Agree(corrections[i], other); });
    if (count > largest.count) largest = {static_cast<int>(i), static_cast<int>(count)};
  }
  return largest;
}

}  // namespace stucco
