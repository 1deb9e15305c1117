// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/expect/expected_poses.h"

#include <cmath>
#include <map>
#include <string>

#include "survey/attitude.h"
#include "survey/median.h"
#include "survey/plan_frame.h"

namespace stucco {
namespace {

constexpr double kElsewhere_m = 100;

// A recorded height this far from the planned one is a mistake, or in yet another system.
constexpr double kHeightAstray_m = 10;
// Offsets of heights are rounded so that a photo more does not move all others, and with them
// everything that is kept of their walls.
constexpr double kHeightStep_m = 0.5;

Eigen::Vector2d Place(const Plan& plan, const GeoPosition& recorded) {
  return PlanFromGeodetic(plan.origin, {recorded.latitude_deg, recorded.longitude_deg});
}

// Recorded minus planned, over photos that have both.
struct Offsets {
  std::optional<double> level_m;             // horizontal distance
  std::optional<double> height_m;            // signed
  std::map<int, double> height_of_flight_m;  // drones set their height to zero at every start
};

Offsets MeasureOffsets(const Plan& plan, const std::vector<const CapturedPhoto*>& photos,
                       const std::vector<const PlannedView*>& views) {
  std::vector<double> level;
  std::vector<double> height;
  std::map<int, std::vector<double>> by_flight;
  for (size_t i = 0; i < photos.size(); ++i) {
    const auto& recorded = photos[i]->position;
    if (!recorded || !views[i]) continue;
    level.push_back((Place(plan, *recorded) - views[i]->position_m.head<2>()).norm());
    if (!recorded->has_height) continue;
    height.push_back(recorded->height_m - views[i]->position_m.z());
    by_flight[views[i]->flight].push_back(height.back());
  }
  const auto rounded = [](double value) {
    return kHeightStep_m * std::round(value / kHeightStep_m);
  };
  Offsets offsets{Median(std::move(level)), Median(std::move(height)), {}};
  if (offsets.height_m) offsets.height_m = rounded(*offsets.height_m);
  for (auto& [flight, values] : by_flight) {
    offsets.height_of_flight_m[flight] = rounded(*Median(std::move(values)));
  }
  return offsets;
}

std::optional<double> ExpectedHeight(const GeoPosition& recorded, const PlannedView* view,
                                     const Offsets& offsets) {
  const std::optional<double> planned = view ? std::optional(view->position_m.z()) : std::nullopt;
  if (!recorded.has_height || !offsets.height_m) return planned;
  const auto of_flight =
      view ? offsets.height_of_flight_m.find(view->flight) : offsets.height_of_flight_m.end();
  const double z =
      recorded.height_m -
      (of_flight != offsets.height_of_flight_m.end() ? of_flight->second : *offsets.height_m);
  return planned && std::abs(z - *planned) > kHeightAstray_m ? planned : z;
}

std::optional<Eigen::Vector3d> ExpectedPosition(const Plan& plan, const CapturedPhoto& photo,
                                                const PlannedView* view, const Offsets& offsets) {
  if (!photo.position) return view ? std::optional(view->position_m) : std::nullopt;
  const auto z = ExpectedHeight(*photo.position, view, offsets);
  if (!z) return std::nullopt;
  const Eigen::Vector2d place = Place(plan, *photo.position);
  return Eigen::Vector3d(place.x(), place.y(), *z);
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
