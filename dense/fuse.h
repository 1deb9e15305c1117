// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <functional>
#include <memory>
#include <vector>

#include "dense/fused_points.h"
#include "dense/view.h"
#include "survey/depth_map.h"
#include "survey/ids.h"
#include "survey/image.h"

namespace stucco {

struct FuseOptions {
  int min_consistent = 2;  // other photos that must agree with a depth
  float max_reprojection_px = 1.5f;
  float max_depth_difference = 0.01f;  // relative
  float max_normal_angle_rad = 1.0f;
  float max_cost = 0.5f;
  int threads = 1;
};

// What is fused, by photo. Maps and pictures are asked for when needed, so that only a photo and
// its neighbours have to be in memory.
struct FuseInput {
  std::vector<PhotoId> ids;                  // that the points name the photos by
  std::vector<PinholeCamera> cameras;        // level 0
  std::vector<std::vector<int>> neighbours;  // indices of other photos that may show the same
  std::function<std::shared_ptr<const DepthMap>(int)> map;
  std::function<std::shared_ptr<const ViewPyramid>(int)> colors;
};

// Fuses depth maps into one cloud: a pixel whose depth enough neighbours confirm (forward-backward
// reprojection, depth, normal) becomes a point, the mean of all that confirm it, each by the
// inverse square of its pixel's size on the surface. Pixels that took part are not used again, nor
// is a pixel made a point where a neighbour that sees the surface about as finely has made one.
// Photos in order, whose points go to `after_photo` (once a photo): the result is always the same,
// and beside what `map` and `colors` hold, memory is a bit for each pixel and the points of one
// photo.
void Fuse(const FuseInput& input, const FuseOptions& options,
          const std::function<void(const FusedPoints&)>& after_photo);

}  // namespace stucco
