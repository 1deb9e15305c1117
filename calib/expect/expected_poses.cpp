// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_poses.h"

#include <algorithm>
#include <map>
#include <string>

#include "survey/attitude.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

constexpr double kElsewhere_m = 100;

std::optional<double> Median(std::vector<double> values) {
  if (values.empty()) return std::nullopt;
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Recorded minus planned, over photos that have both.
struct Offsets {
  std::optional<double> level_m;   // horizontal distance
  std::optional<double> height_m;  // signed
};

Offsets MeasureOffsets(const Plan& plan, const std::vector<const CapturedPhoto*>& photos,
                       const std::vector<const PlannedView*>& views) {
  std::vector<double> level;
  std::vector<double> height;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto& recorded = photos[i]->position;
    if (!recorded || !views[i]) continue;
    const Eigen::Vector2d place =
        PlanFromGeodetic(plan.origin, {recorded->latitude_deg, recorded->longitude_deg});
    level.push_back((place - views[i]->position_m.head<2>()).norm());
    if (recorded->has_height) height.push_back(recorded->height_m - views[i]->position_m.z());
  }
  return {Median(std::move(level)), Median(std::move(height))};
}

std::optional<Eigen::Vector3d> ExpectedPosition(const Plan& plan, const CapturedPhoto& photo,
                                                const PlannedView* view, const Offsets& offsets) {
  const auto& recorded = photo.position;
  if (!recorded) return view ? std::optional(view->position_m) : std::nullopt;
  const bool height_known = recorded->has_height && offsets.height_m;
  if (!height_known && !view) return std::nullopt;
  const Eigen::Vector2d place =
      PlanFromGeodetic(plan.origin, {recorded->latitude_deg, recorded->longitude_deg});
  const double z = height_known ? recorded->height_m - *offsets.height_m : view->position_m.z();
  return Eigen::Vector3d(place.x(), place.y(), z);
}

std::optional<GimbalAngles> ExpectedAngles(const CapturedPhoto& photo, const PlannedView* view) {
  if (photo.gimbal) return photo.gimbal;
  if (view) return GimbalAngles{view->yaw_deg, view->pitch_deg, 0};
  return std::nullopt;
}

}  // namespace

std::vector<std::optional<Pose>> ExpectedPoses(const Plan& plan,
                                               const std::vector<const CapturedPhoto*>& photos) {
  std::map<std::string, const PlannedView*> view_of_id;
  for (const PlannedView& view : plan.views) view_of_id[view.id] = &view;
  std::vector<const PlannedView*> views;
  for (const CapturedPhoto* photo : photos) {
    const auto found = view_of_id.find(photo->view);
    views.push_back(found == view_of_id.end() ? nullptr : found->second);
  }
  std::vector<std::optional<Pose>> poses(photos.size());
  const Offsets offsets = MeasureOffsets(plan, photos, views);
  if (offsets.level_m && *offsets.level_m > kElsewhere_m) return poses;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto position = ExpectedPosition(plan, *photos[i], views[i], offsets);
    const auto angles = ExpectedAngles(*photos[i], views[i]);
    if (!position || !angles) continue;
    const Eigen::Quaterniond rotation = CamFromEnu(*angles);
    poses[i] = Pose{rotation, -(rotation * *position)};
  }
  return poses;
}

}  // namespace stucco
