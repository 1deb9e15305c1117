// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "survey/image.h"
#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/photos/photo_cache.h"
#include "texture/photos/resample.h"
#include "texture/views/candidates.h"

namespace stucco {

// A photo that was chosen for a facet, with everything its texels depend on.
struct PhotoLayer {
  const SurveyPhoto* photo = nullptr;
  // Opens the photo in full size. Large facets have more photos than fit into memory at once: what
  // it returns is held only while it is read.
  std::function<std::shared_ptr<const PhotoPyramid>()> open;
  Eigen::Vector3d gain = Eigen::Vector3d::Ones();
  GridShift shift;           // in texels of the facet's grid
  std::vector<Sight> sight;  // over the selection raster
};

// Which chosen photo paints what, over a raster of `step` x `step` texels.
struct Ownership {
  int step = 1;
  int raster_width = 0;
  std::vector<int> owner;  // index into the chosen photos, -1: none

  size_t RasterIndex(int column, int row) const {
    return static_cast<size_t>(row / step) * raster_width + column / step;
  }
};

struct Composite {
  Image picture;                // 3 channels
  std::vector<uint8_t> labels;  // 1 + index of the photo that painted a texel, 0: nobody
};

// Paints the facet's picture tile by tile, so that memory does not grow with the facet: each photo
// resampled with its shift and gain, joined at the borders of ownership (over several bands where
// `blend` is set). Texels outside `mask` stay 0 in the labels.
Composite ComposePicture(const TexelGrid& grid, const std::vector<uint8_t>& mask,
                         const std::vector<PhotoLayer>& chosen, const Ownership& ownership,
                         bool blend);

}  // namespace stucco
