// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/known_poses.h"

#include <Eigen/Cholesky>
#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <limits>
#include <numbers>

#include "calib/scene/hovers.h"
#include "survey/median.h"

namespace stucco {
namespace {

// Fewer observations hold no pose surely.
constexpr int kEnoughObservations = 100;
// Of poses that many observations hold.
constexpr double kKnownSigma_m = 0.05;
constexpr double kKnownSigma_rad = 0.1 * std::numbers::pi / 180;
constexpr size_t kMostPoints = 20000;
constexpr double kMostOffset_m = 6;
constexpr double kStep_m = 0.5;
constexpr double kOnWall_m = 0.4;
constexpr double kOffGround_m = 1;  // and roofs: what lies there may belong to them
constexpr size_t kLeastOnWalls = 100;
constexpr int kRounds = 5;

// A point near the plane of a wall.
struct NearWall {
  Eigen::Vector2d normal = Eigen::Vector2d::UnitX();
  double distance_m = 0;  // before the wall
};

std::vector<NearWall> PointsNearWalls(std::span<const Eigen::Vector3d> points,
                                      std::span<const PlannedFacade> walls) {
  std::vector<NearWall> near;
  const size_t step = points.size() / kMostPoints + 1;
  for (size_t i = 0; i < points.size(); i += step) {
    const Eigen::Vector3d& p = points[i];
    for (const PlannedFacade& wall : walls) {
      if (p.z() < wall.z_m.from_m + kOffGround_m || p.z() > wall.z_m.to_m - kOffGround_m) continue;
      const Eigen::Vector2d from = p.head<2>() - wall.a_m;
      const double along = from.dot(wall.along());
      const double distance = from.dot(wall.outwards());
      if (along < 0 || along > wall.length_m() || std::abs(distance) > kMostOffset_m) continue;
      near.push_back({wall.outwards(), distance});
    }
  }
  return near;
}

size_t NumOnWalls(const std::vector<NearWall>& points, const Eigen::Vector2d& shift) {
  return std::ranges::count_if(points, [&](const NearWall& point) {
    return std::abs(point.distance_m + point.normal.dot(shift)) < kOnWall_m;
  });
}

// Least squares over the points that are on walls after the shift.
Eigen::Vector2d Refined(const std::vector<NearWall>& points, Eigen::Vector2d shift) {
  for (int round = 0; round < kRounds; ++round) {
    Eigen::Matrix2d normals = 1e-3 * Eigen::Matrix2d::Identity();
    Eigen::Vector2d right = Eigen::Vector2d::Zero();
    for (const NearWall& point : points) {
      const double off = point.distance_m + point.normal.dot(shift);
      if (std::abs(off) > kOnWall_m) continue;
      normals += point.normal * point.normal.transpose();
      right -= off * point.normal;
    }
    shift += normals.ldlt().solve(right);
  }
  return shift;
}

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
    return KnownPose{*photo.pose, kKnownSigma_m, kKnownSigma_rad};
  }
  const double recorded_m =
      photo.prior ? std::max(photo.prior->sigma_horizontal_m, photo.prior->sigma_vertical_m)
                  : std::numeric_limits<double>::infinity();
  if (photo.attitude && hover && hover->sigma_m < recorded_m) {
    const Eigen::Quaterniond& rotation = photo.attitude->cam_from_world;
    return KnownPose{Pose{rotation, -(rotation * hover->middle)}, hover->sigma_m,
                     photo.attitude->sigma_rad, false};
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

Eigen::Vector2d ShiftOntoWalls(std::span<const Eigen::Vector3d> points,
                               std::span<const PlannedFacade> walls) {
  const std::vector<NearWall> near = PointsNearWalls(points, walls);
  const int steps = static_cast<int>(kMostOffset_m / kStep_m);
  Eigen::Vector2d best = Eigen::Vector2d::Zero();
  size_t most = std::max(kLeastOnWalls, NumOnWalls(near, best));
  for (int x = -steps; x <= steps; ++x) {
    for (int y = -steps; y <= steps; ++y) {
      const Eigen::Vector2d shift = kStep_m * Eigen::Vector2d(x, y);
      const size_t count = NumOnWalls(near, shift);
      if (count <= most) continue;
      most = count;
      best = shift;
    }
  }
  if (NumOnWalls(near, best) < kLeastOnWalls) return Eigen::Vector2d::Zero();
  return Refined(near, best);
}

std::vector<std::optional<KnownPose>> KnowPoses(const KnowInput& input, const Scene& scene) {
  assert(input.guidance.views && input.records.size() == scene.photos.size());
  Eigen::Vector3d plan_from_world = PlanFromRecords(*input.guidance.views, input.records);
  std::vector<Eigen::Vector3d> points;
  for (const SceneTrack& track : scene.tracks) {
    if (track.position) points.push_back(*track.position + plan_from_world);
  }
  plan_from_world.head<2>() += ShiftOntoWalls(points, input.guidance.facades);
  const std::vector<bool> surely = SurelyPosed(input.repeating, scene);
  const std::vector<std::vector<int>> mates = HoverMates(scene);
  std::vector<std::optional<KnownPose>> known(scene.photos.size());
  for (size_t i = 0; i < known.size(); ++i) {
    known[i] = KnowPose(scene.photos[i], surely[i], PlaceOfHover(scene, mates[i], surely));
    if (!known[i]) continue;
    Pose& pose = known[i]->cam_from_plan;
    pose = Pose{pose.rotation, -(pose.rotation * (pose.Center() + plan_from_world))};
  }
  return known;
}

}  // namespace stucco
