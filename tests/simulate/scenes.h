// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <string>

#include "simulate/scene/scene.h"
#include "survey/camera.h"
#include "survey/image.h"
#include "survey/pose.h"

namespace stucco::test {

// A parallelogram whose picture has its top-left corner at `top_left`, its top-right at
// top_left + right and its bottom-left at top_left + down; the front is at down x right.
struct Quad {
  Eigen::Vector3f top_left;
  Eigen::Vector3f right;
  Eigen::Vector3f down;
};

int AddMaterial(simulate::Scene& scene, const simulate::Material& material);
int AddTexture(simulate::Scene& scene,
               const Image& image);  // and a material with it: returns the material
void AddQuad(simulate::Scene& scene, const Quad& quad, int material,
             const std::string& element = "part", float repeats = 1);
// Axis-aligned, walls outwards.
void AddBox(simulate::Scene& scene, const Eigen::Vector3f& low, const Eigen::Vector3f& high,
            int material, const std::string& element);

// Squares of `square_px`, the top-left one black.
Image Checkerboard(int columns, int rows, int square_px);
Image Plain(uint8_t value);

// x right, y down; z of the camera from `from` to `to`. `up` must not be parallel to it.
Pose LookAt(const Eigen::Vector3d& from, const Eigen::Vector3d& to,
            const Eigen::Vector3d& up = Eigen::Vector3d::UnitZ());
Camera Pinhole(int width_px, int height_px, double focal_px);

}  // namespace stucco::test
