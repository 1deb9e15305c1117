// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "survey/camera.h"
#include "survey/ids.h"
#include "survey/pose.h"

namespace stucco {

struct Observation {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  PointId point;  // invalid: not triangulated
};

// A photo with a known pose: what COLMAP calls a registered image.
struct RegisteredImage {
  PhotoId id;
  CameraId camera;
  std::string name;  // path relative to the photo folder, '/' between folders
  Pose cam_from_world;
  std::vector<Observation> observations;
};

struct TrackElement {
  PhotoId photo;
  uint32_t observation = 0;  // index into RegisteredImage::observations
  auto operator<=>(const TrackElement&) const = default;  // NOLINT(modernize-use-nullptr)
};

struct TrackPoint {
  PointId id;
  Eigen::Vector3d position = Eigen::Vector3d::Zero();  // world
  std::array<uint8_t, 3> rgb = {0, 0, 0};
  double error_px = -1;  // mean reprojection error; -1: not known
  std::vector<TrackElement> track;
};

// Ordered maps, so that every walk over a reconstruction has the same order everywhere.
struct Reconstruction {
  std::map<CameraId, Camera> cameras;
  std::map<PhotoId, RegisteredImage> photos;
  std::map<PointId, TrackPoint> points;
};

// The first dangling id, track without its observation or bad camera, or nothing.
std::optional<std::string> FindProblem(const Reconstruction& reconstruction);

// Moves the whole reconstruction into a new world frame.
void Transform(const Similarity& new_from_old, Reconstruction& reconstruction);

// Mean distance in pixels between observations and reprojected points; 0 without observations.
double MeanReprojectionError(const Reconstruction& reconstruction);

double MeanTrackLength(const Reconstruction& reconstruction);

}  // namespace stucco
