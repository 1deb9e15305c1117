// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <vector>

#include "survey/camera.h"
#include "survey/image.h"
#include "survey/pose.h"
#include "survey/survey_photo.h"

namespace stucco {

// Intrinsics of an undistorted image. Unlike survey/camera.h, the centre of the top-left pixel is
// at (0, 0): pixel coordinates are array indices.
struct PinholeCamera {
  int width = 0;
  int height = 0;
  float fx = 0, fy = 0, cx = 0, cy = 0;
  Eigen::Matrix3f rotation = Eigen::Matrix3f::Identity();  // cam_from_world
  Eigen::Vector3d translation = Eigen::Vector3d::Zero();

  Eigen::Vector3f Ray(float x, float y) const { return {(x - cx) / fx, (y - cy) / fy, 1}; }
};

// Grey pixel (x, y) with its right, lower and lower right neighbours in one word, from the low byte
// up: one load fetches what bilinear interpolation needs.
struct PackedImage {
  int width = 0;
  int height = 0;
  std::vector<uint32_t> quads;
  std::vector<uint8_t> gray;
};

PackedImage Pack(int width, int height, std::vector<uint8_t> gray);

// A photo undistorted and reduced, as a pyramid: level 0 is the finest.
struct ViewPyramid {
  std::vector<PinholeCamera> cameras;
  std::vector<PackedImage> images;
  Image color;  // level 0
};

// The geometry of a photo's levels without its pixels.
std::vector<PinholeCamera> PinholeLevels(const Camera& camera, const Pose& cam_from_world,
                                         int max_image_px, int num_levels);

// Decodes, undistorts (bilinear after area reduction) and reduces a photo.
std::shared_ptr<const ViewPyramid> LoadView(const std::filesystem::path& photo_folder,
                                            const SurveyPhoto& photo, int max_image_px,
                                            int num_levels);

}  // namespace stucco
