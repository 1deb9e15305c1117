// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dense/view.h"
#include "survey/depth_map.h"
#include "survey/ids.h"
#include "survey/image.h"
#include "survey/point_cloud.h"

namespace stucco {

struct FuseOptions {
  int min_consistent = 2;  // other photos that must agree with a depth
  float max_reprojection_px = 1.5f;
  float max_depth_difference = 0.01f;  // relative
  float max_normal_angle_rad = 1.0f;
  float max_cost = 0.6f;
};

// What is fused, by photo. Maps and pictures are asked for when needed, so that only a photo and
// its sources have to be in memory.
struct FuseInput {
  std::vector<PhotoId> ids;               // that the cloud names the photos by
  std::vector<PinholeCamera> cameras;     // level 0
  std::vector<std::vector<int>> sources;  // indices of other photos
  std::function<std::shared_ptr<const DepthMap>(int)> map;
  std::function<std::shared_ptr<const ViewPyramid>(int)> colors;
};

// Fuses depth maps into one cloud: a pixel whose depth enough sources confirm (forward-backward
// reprojection, depth, normal) becomes a point, the mean of all that confirm it; pixels that took
// part are not used again. Photos in order, so the result is always the same.
PointCloud Fuse(const FuseInput& input, const FuseOptions& options,
                const std::function<void()>& after_photo);

}  // namespace stucco
