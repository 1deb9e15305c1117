// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "survey/ids.h"

namespace stucco {

// COLMAP's camera models (src/colmap/sensor/models.h) with its numbers and parameter order:
//   SIMPLE_PINHOLE f cx cy               PINHOLE fx fy cx cy
//   SIMPLE_RADIAL  f cx cy k             RADIAL  f cx cy k1 k2
//   OPENCV fx fy cx cy k1 k2 p1 p2       FULL_OPENCV fx fy cx cy k1 k2 p1 p2 k3 k4 k5 k6
enum class CameraModel {
  kSimplePinhole = 0,
  kPinhole = 1,
  kSimpleRadial = 2,
  kRadial = 3,
  kOpenCv = 4,
  kFullOpenCv = 6,
};

std::string_view Name(CameraModel model);  // "FULL_OPENCV"
std::optional<CameraModel> CameraModelFromName(std::string_view name);
std::optional<CameraModel> CameraModelFromNumber(int number);
std::span<const std::string_view> ParameterNames(CameraModel model);  // {"fx", "fy", ...}

// What a parameter is: COLMAP's focal_length_idxs, principal_point_idxs and extra_params_idxs, the
// extra ones apart by how large they get and how well photos determine them.
enum class ParameterKind {
  kFocalLength,
  kPrincipalPoint,
  kRadial,      // k, k1, k2
  kTangential,  // p1, p2
  kRational,    // k3 ... k6 of FULL_OPENCV
};
std::span<const ParameterKind> ParameterKinds(CameraModel model);  // in the order of the names

// Pixel (0.5, 0.5) is the centre of the top-left pixel. Camera frame: x right, y down, z forward.
// What it computes requires as many parameters as the model has.
struct Camera {
  CameraId id;
  CameraModel model = CameraModel::kPinhole;
  int width_px = 0;
  int height_px = 0;
  std::vector<double> params;  // in the order of ParameterNames(model)

  double FocalX() const { return params[0]; }
  double FocalY() const;
  Eigen::Vector2d PrincipalPoint() const;

  // Ray direction (x/z, y/z) -> pixel, lens distortion applied.
  Eigen::Vector2d Distort(const Eigen::Vector2d& normalized) const;
  // Point in the camera frame -> pixel; nothing at or behind the camera's plane (z <= 0).
  std::optional<Eigen::Vector2d> Project(const Eigen::Vector3d& point_in_cam) const;
  // Pixel -> (x/z, y/z). Newton iteration, residual below 1e-10; nothing where the distortion
  // polynomial cannot be inverted.
  std::optional<Eigen::Vector2d> Unproject(const Eigen::Vector2d& pixel) const;
  // True where the distortion is still one-to-one (its radial derivative is positive) at this ray.
  bool IsInvertibleAt(const Eigen::Vector2d& normalized) const;
  bool Contains(const Eigen::Vector2d& pixel) const;
};

// The same lens seen through an image resized to width x height pixels. Requires sizes above 0.
Camera Resized(const Camera& camera, int width_px, int height_px);

// What is wrong with a camera (size, number of parameters, not finite, focal length <= 0), or
// nothing.
std::optional<std::string> FindProblem(const Camera& camera);

}  // namespace stucco
