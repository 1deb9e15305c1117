// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/exchange/made_model.h"

#include <Eigen/Geometry>
#include <random>

namespace stucco {

Reconstruction MadeModel() {
  Reconstruction model;
  model.cameras[CameraId{1}] = {
      CameraId{1},
      CameraModel::kFullOpenCv,
      200,
      100,
      {161.3, 160.9, 101.7, 48.2, -0.11, 0.031, 0.0007, -0.0004, -0.012, 0.0, 0.0, 0.0}};
  model.cameras[CameraId{2}] = {
      CameraId{2}, CameraModel::kRadial, 200, 100, {173.1, 99.1, 50.3, 0.05, -0.01}};
  const char* const names[] = {"a.jpg", "b.jpg", "sub/c.jpg"};
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(-1, 1);
  for (uint32_t i = 0; i < 3; ++i) {
    const PhotoId id{i + 1};
    RegisteredImage& photo = model.photos[id];
    photo.id = id;
    photo.camera = CameraId{i == 2 ? 2u : 1u};
    photo.name = names[i];
    photo.cam_from_world.rotation =
        Eigen::Quaterniond(1, 0.1 * unit(random), 0.1 * unit(random), 0.1 * unit(random))
            .normalized();
    photo.cam_from_world.translation = {5.0 * i + unit(random), unit(random), unit(random)};
  }
  for (uint64_t i = 1; i <= 20; ++i) {
    const PointId id{i};
    TrackPoint& point = model.points[id];
    point.id = id;
    point.position = {4 * unit(random), 3 * unit(random), 30 + 5 * unit(random)};
    point.rgb = {static_cast<uint8_t>(3 * i), static_cast<uint8_t>(255 - i), 0};
    for (auto& [photo_id, photo] : model.photos) {
      const auto pixel =
          model.cameras.at(photo.camera).Project(photo.cam_from_world * point.position);
      point.track.push_back({photo_id, static_cast<uint32_t>(photo.observations.size())});
      photo.observations.push_back(
          {*pixel + 0.2 * Eigen::Vector2d(unit(random), unit(random)), id});
    }
  }
  return model;
}

Georef MadePlace() {
  Georef georef;
  georef.frame = "enu";
  georef.metric = true;
  georef.up = Eigen::Vector3d::UnitZ();
  georef.source = "gps";
  georef.origin_latitude_deg = 52.0123456789;
  georef.origin_longitude_deg = 4.3612345678;
  georef.origin_height_m = 43.21;
  return georef;
}

}  // namespace stucco
