// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/simulate/made_flight.h"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

namespace stucco::simulate {
namespace {

// Where a ray meets a box from outside or from inside.
std::optional<RayHit> MeetBox(const Eigen::AlignedBox3d& box, const Eigen::Vector3d& from,
                              const Eigen::Vector3d& direction, int element) {
  std::optional<RayHit> nearest;
  for (int axis = 0; axis < 3; ++axis) {
    for (const double plane : {box.min()[axis], box.max()[axis]}) {
      const double distance = (plane - from[axis]) / direction[axis];
      if (!(distance > 1e-9) || (nearest && distance >= nearest->distance)) continue;
      Eigen::Vector3d point = from + distance * direction;
      point[axis] = plane;
      if (!box.contains(point)) continue;
      nearest = RayHit{point, Eigen::Vector3d::Unit(axis), distance, element};
    }
  }
  return nearest;
}

}  // namespace

SceneShape MadeScene(double ground_m) {
  SceneShape shape;
  const Eigen::AlignedBox3d house(Eigen::Vector3d(0, 0, ground_m),
                                  Eigen::Vector3d(12, 8, ground_m + 6));
  shape.box = Eigen::AlignedBox3d(Eigen::Vector3d(-100, -100, ground_m),
                                  Eigen::Vector3d(100, 100, ground_m + 6));
  shape.elements = {"G0", "B0001"};
  shape.is_ours = true;
  shape.cast = [=](const Eigen::Vector3d& from,
                   const Eigen::Vector3d& direction) -> std::optional<RayHit> {
    auto hit = MeetBox(house, from, direction, 1);
    const double distance = (ground_m - from.z()) / direction.z();
    const Eigen::Vector3d point = from + distance * direction;
    const bool is_on_ground = distance > 1e-9 && point.head<2>().cwiseAbs().maxCoeff() <= 100;
    if (is_on_ground && (!hit || distance < hit->distance)) {
      hit = RayHit{point, Eigen::Vector3d::UnitZ(), distance, 0};
    }
    return hit;
  };
  return shape;
}

SceneInfo MadeSceneInfo() {
  SceneInfo info;
  info.georef.frame = "enu";
  info.georef.origin_latitude_deg = 50.1;
  info.georef.origin_longitude_deg = 14.2;
  info.georef.origin_height_m = 250;
  return info;
}

Plan MadePlan(int views) {
  Plan plan;
  plan.method = "made";
  plan.origin = {50.1, 14.2, 0};
  plan.crs = "+proj=tmerc +lat_0=50.1 +lon_0=14.2 +k=1 +x_0=0 +y_0=0 +datum=WGS84 +units=m";
  plan.camera = {"mavic-3e", "Mavic", 12.29e-3, 17.3e-3, 13e-3, 5280, 3956};
  plan.d_min_m = 10;
  plan.home_m = {-30, -30, 0};
  PlannedFootprint house;
  house.building = "B0001";
  house.rings_m = {{{0, 0}, {12, 0}, {12, 8}, {0, 8}}};
  house.z_m = {0, 6};
  plan.footprints = {house};
  PlannedFacade wall;
  wall.id = "B0001/F00";
  wall.b_m = {12, 0};
  wall.z_m = {0, 6};
  plan.facades = {wall};
  for (int i = 0; i < views; ++i) {
    PlannedView view;
    view.id = fmt::format("h{:04d}v{}", i / 2, i % 2);
    view.hover = i / 2;
    view.order = i;
    const double angle = 2 * std::numbers::pi * (i / 2) / std::max(1, (views + 1) / 2);
    view.position_m = {6 + 26 * std::sin(angle), 4 + 26 * std::cos(angle), 5.0 + i % 6 / 2};
    view.yaw_deg = std::remainder(angle * 57.29577951308232 + 180, 360);
    view.pitch_deg = i % 2 == 0 ? 0 : -20;
    view.targets = {{"B0001/F00", {0, 12}, {0, 6}}};
    plan.views.push_back(view);
    plan.facades[0].views.push_back(view.id);
  }
  return plan;
}

Photographer MadePhotographer() {
  Photographer photographer;
  const auto ray_at = [](const Camera& camera, const Pose& pose, int x, int y) {
    const auto ray = camera.Unproject({x + 0.5, y + 0.5});
    const Eigen::Vector3d in_camera(ray->x(), ray->y(), 1);
    return Eigen::Vector3d(pose.rotation.conjugate() * in_camera);
  };
  photographer.photograph = [ray_at](const Camera& camera, const Pose& pose, const Light& light,
                                     int /*threads*/) {
    Radiance picture{camera.width_px, camera.height_px, {}};
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Eigen::Vector3d ray = ray_at(camera, pose, x, y);
        const Eigen::Vector3d ground = pose.Center() - pose.Center().z() / ray.z() * ray;
        const bool is_white = std::fmod(std::floor(ground.x()) + std::floor(ground.y()), 2) == 0;
        const Eigen::Vector3f colour =
            ray.z() >= 0 ? light.sky : Eigen::Vector3f(light.sun * (is_white ? 0.6f : 0.2f));
        for (int c = 0; c < 3; ++c) picture.rgb.push_back(colour[c]);
      }
    }
    return picture;
  };
  photographer.depth = [ray_at](const Camera& camera, const Pose& pose, int /*threads*/) {
    std::vector<float> depths;
    for (int y = 0; y < camera.height_px; ++y) {
      for (int x = 0; x < camera.width_px; ++x) {
        const Eigen::Vector3d ray = ray_at(camera, pose, x, y);
        depths.push_back(ray.z() < 0 ? static_cast<float>(-pose.Center().z() / ray.z()) : 0.0f);
      }
    }
    return ExactDepths(camera.width_px, camera.height_px, std::move(depths));
  };
  return photographer;
}

}  // namespace stucco::simulate
