// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/photos/photo_cache.h"

namespace stucco {

// A small smooth shift of a photo on a facet, in texels of the facet's grid: the texel at `x` shows
// what the photo has at `x + At(x)`. The eight terms are those of a homography near the identity to
// first order: d = a + B q + q (c . q) with q = (x - center) / radius.
struct GridShift {
  Eigen::Vector2d center = Eigen::Vector2d::Zero();
  double radius = 1;
  Eigen::Matrix<double, 8, 1> terms = Eigen::Matrix<double, 8, 1>::Zero();  // a, B by row, c

  bool IsZero() const { return terms.isZero(0); }
  Eigen::Vector2d At(const Eigen::Vector2d& x) const;
};

// A rectangle of texels.
struct Tile {
  int x = 0;
  int y = 0;
  int width = 0;
  int height = 0;
  size_t size() const { return static_cast<size_t>(width) * height; }
};

// What one photo shows on a rectangle of a facet's grid.
struct SampledTile {
  std::vector<float> rgb;      // 3 per texel, 0 to 255; 0 where not valid
  std::vector<uint8_t> valid;  // the photo shows the texel
};

// Resamples a photo onto texels: lens distortion and perspective are evaluated on a lattice that is
// fine enough for 0.05 pixel and interpolated between (exactly where it is not); photo pixels
// smaller than texels are averaged (nearest halving of the photo, then several bicubic taps along
// the longer side of the texel's footprint), larger ones interpolated bicubically (Catmull-Rom).
SampledTile SamplePhoto(const SurveyPhoto& photo, const PhotoPyramid& pyramid,
                        const TexelGrid& grid, const Tile& tile, const GridShift& shift = {});

}  // namespace stucco
