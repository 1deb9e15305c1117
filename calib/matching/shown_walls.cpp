// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/matching/shown_walls.h"

#include <cstddef>

#include "calib/expect/project_inside.h"
#include "calib/features/descriptors.h"

namespace stucco {
namespace {

constexpr size_t kLeastKeypointsOnWall = 10;

void Append(const std::vector<int16_t>& descriptors, size_t row, const OnWall& place,
            int32_t of_photo, Shown& shown) {
  const auto begin = descriptors.begin() + static_cast<std::ptrdiff_t>(row) * kDescriptorSize;
  shown.on_wall.descriptors.insert(shown.on_wall.descriptors.end(), begin, begin + kDescriptorSize);
  shown.on_wall.places.push_back(place);
  shown.of_photo.push_back(of_photo);
}

WallView ViewOf(const AgainInput& input, int photo, int wall) {
  return {input.set.guidance.facades[wall], {}, {}, input.poses[photo]->cam_from_plan};
}

}  // namespace

ShownWalls ShowWalls(const AgainInput& input, int photo) {
  ShownWalls walls;
  const std::vector<int>& wall_of = input.repeating.wall_of[photo];
  if (!input.poses[photo] || wall_of.empty()) return walls;
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  const DetectInput detect{input.options, input.set, input.context};
  const Features plain = FeaturesOfPhoto(detect, input.features, photo);
  const std::vector<int16_t> descriptors = UnitDescriptors(plain);
  for (size_t k = 0; k < wall_of.size(); ++k) {
    if (wall_of[k] < 0) continue;
    const auto place = PlaceOnWall(plain.keypoints[k], camera, ViewOf(input, photo, wall_of[k]));
    if (place) Append(descriptors, k, *place, static_cast<int32_t>(k), walls[wall_of[k]]);
  }
  for (auto run = input.features.walls.lower_bound({photo, 0});
       run != input.features.walls.end() && run->first.first == photo; ++run) {
    const int wall = run->first.second;
    if (!input.repeating.period_m.contains(wall)) continue;
    const Features features = FeaturesOnWall(detect, input.features, photo, wall);
    const std::vector<int16_t> rows = UnitDescriptors(features);
    for (size_t k = 0; k < features.size(); ++k) {
      const auto place = PlaceOnWall(features.keypoints[k], camera, ViewOf(input, photo, wall));
      if (place) {
        Append(rows, k, *place, static_cast<int32_t>(run->second.begin + k), walls[wall]);
      }
    }
  }
  std::erase_if(
      walls, [](const auto& each) { return each.second.of_photo.size() < kLeastKeypointsOnWall; });
  for (auto& [wall, shown] : walls) {
    const PlannedFacade& facade = input.set.guidance.facades[wall];
    const Eigen::Vector2d middle = (facade.a_m + facade.b_m) / 2;
    shown.distance_m = (input.poses[photo]->cam_from_plan.Center().head<2>() - middle).norm();
  }
  return walls;
}

bool ShowsPlace(const AgainInput& input, int photo, int wall, const Eigen::Vector2d& place) {
  const PlannedFacade& facade = input.set.guidance.facades[wall];
  const Camera& camera = input.set.captures.cameras[input.set.photos[photo]->camera].intrinsics;
  const Eigen::Vector2d level = facade.a_m + place.x() * facade.along();
  const Eigen::Vector3d point(level.x(), level.y(), place.y());
  return ProjectInside(camera, input.poses[photo]->cam_from_plan * point).has_value();
}

Eigen::Vector2d PlaceVariances(const KnownPose& pose, double distance_m) {
  const double angles = distance_m * pose.sigma_rad;
  return pose.sigma_m.cwiseAbs2().array() + angles * angles;
}

}  // namespace stucco
