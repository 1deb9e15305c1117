// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <gtest/gtest.h>

#include <Eigen/Geometry>
#include <functional>
#include <string>

#include "survey/error.h"
#include "survey/reconstruction.h"
#include "tests/survey/temporary_folder.h"

namespace stucco::test {

// The Error that `call` throws; a test failure when it throws none or something else.
inline Error ErrorOf(const std::function<void()>& call) {
  try {
    call();
  } catch (const Error& error) {
    return error;
  } catch (const std::exception& other) {
    ADD_FAILURE() << "not an Error but: " << other.what();
    return Error(ErrorKind::kStageFailed, "");
  }
  ADD_FAILURE() << "no error";
  return Error(ErrorKind::kStageFailed, "");
}

inline void ExpectBadInput(const std::function<void()>& call, const std::string& part) {
  const Error error = ErrorOf(call);
  EXPECT_EQ(error.kind(), ErrorKind::kBadInput) << error.what();
  EXPECT_NE(std::string(error.what()).find(part), std::string::npos)
      << "\"" << error.what() << "\" does not hold \"" << part << "\"";
}

// False for an Error; anything else is a failure of the test. For damaged input that may by chance
// still be valid.
inline bool Accepts(const std::function<void()>& call) {
  try {
    call();
    return true;
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::kBadInput) << error.what();
    return false;
  }
}

// Two cameras, three photos, four points; pixels are exact projections of the points.
inline Reconstruction MakeReconstruction() {
  Reconstruction r;
  r.cameras[CameraId{1}] = {CameraId{1}, CameraModel::kPinhole, 640, 480, {500, 510, 320, 240}};
  r.cameras[CameraId{7}] = {
      CameraId{7},
      CameraModel::kFullOpenCv,
      800,
      600,
      {600, 601, 400.25, 300.125, -0.1, 0.01, 1e-3, -2e-3, 1.0 / 3, 0.02, -0.003, 1e-4}};
  for (uint32_t i = 1; i <= 3; ++i) {
    RegisteredImage photo;
    photo.id = PhotoId{i};
    photo.camera = CameraId{i == 3 ? 7u : 1u};
    photo.name = "flight 1/DJI_000" + std::to_string(i) + ".JPG";
    photo.cam_from_world.rotation =
        Eigen::AngleAxisd(0.05 * i, Eigen::Vector3d(1, 2, -3).normalized());
    photo.cam_from_world.translation = Eigen::Vector3d(0.1 * i, -0.2, 10.0 + 1.0 / 3);
    r.photos[photo.id] = photo;
  }
  for (uint64_t i = 0; i < 4; ++i) {
    TrackPoint point;
    point.id = PointId{i + 10};
    point.position = Eigen::Vector3d(0.3 * static_cast<double>(i) - 0.5, 0.7, 1.0 / 7);
    point.rgb = {static_cast<uint8_t>(i), 128, 255};
    point.error_px = 0.25;
    for (auto& [id, photo] : r.photos) {
      if (i == 3 && id.value == 2) continue;
      const Camera& camera = r.cameras.at(photo.camera);
      const auto pixel = camera.Project(photo.cam_from_world * point.position);
      point.track.push_back({id, static_cast<uint32_t>(photo.observations.size())});
      photo.observations.push_back({*pixel, point.id});
    }
    r.points[point.id] = point;
  }
  r.photos.at(PhotoId{1}).observations.push_back({{1.5, 2.5}, PointId{}});
  return r;
}

}  // namespace stucco::test
