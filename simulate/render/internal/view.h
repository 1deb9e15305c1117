// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <limits>
#include <memory>
#include <mutex>
#include <vector>

#include "simulate/render/internal/ray_scene.h"
#include "simulate/render/pictures.h"
#include "survey/camera.h"
#include "survey/pose.h"

namespace stucco::simulate::internal {

// Camera::Unproject over a picture, tabulated on a grid so fine that what lies between its nodes
// is linear to a thousandth of a pixel (checked in the middle of every cell).
class LensTable {
 public:
  explicit LensTable(const Camera& camera);

  // (x/z, y/z); NaN where the lens shows nothing.
  Eigen::Vector2d At(double x, double y) const;
  // Its change for one pixel to the right and one down; at the rim of the lens, the axis's.
  struct Slopes {
    Eigen::Vector2d right, down;
  };
  Slopes SlopesAt(double x, double y) const;
  bool IsOf(const Camera& camera) const;

 private:
  struct Cell {
    const Eigen::Vector2d* node = nullptr;  // its upper left one
    double tx = 0, ty = 0;                  // the place in it, in [0, 1]
  };
  Cell CellAt(double x, double y) const;

  Camera camera_;
  int spacing_px_ = 1;
  int columns_ = 0;
  std::vector<Eigen::Vector2d> nodes_;
};

// The tables of the last few cameras.
class LensTables {
 public:
  std::shared_ptr<const LensTable> For(const Camera& camera);

 private:
  std::mutex mutex_;
  std::vector<std::shared_ptr<const LensTable>> tables_;
};

// The rays of a picture. Those of a camera have directions of length 1 along its axis, so that the
// way along them is depth.
struct View {
  int width_px = 0;
  int height_px = 0;
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  // of the ray at pixel (0, 0)
  Eigen::Vector3d origin_right = Eigen::Vector3d::Zero();
  Eigen::Vector3d origin_down = Eigen::Vector3d::Zero();
  // Of all rays where there is no lens, and along the axis of one.
  Eigen::Vector3f direction = Eigen::Vector3f::Zero();
  double to = std::numeric_limits<double>::infinity();
  Eigen::Matrix3f world_from_cam = Eigen::Matrix3f::Identity();
  std::shared_ptr<const LensTable> lens;
};

View ViewOf(std::shared_ptr<const LensTable> lens, const Camera& camera,
            const Pose& cam_from_world);
View ViewOf(const PicturePlane& plane);

// A ray and how it moves from pixel to pixel (Igehy, "Tracing ray differentials", SIGGRAPH 1999).
struct ViewRay {
  Ray ray;
  Eigen::Vector3f origin_right, origin_down, direction_right, direction_down;
};

// False where the lens shows nothing.
bool RayAt(const View& view, double x, double y, Ray& ray);
// The ray at a place, as RayAt gives it, with its neighbours.
ViewRay ViewRayOf(const View& view, double x, double y, const Ray& ray);

}  // namespace stucco::simulate::internal
