// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <vector>

#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/photos/photo_cache.h"

namespace stucco {

// Photos from nearly the same side show the same on any plane: the least difference of their slants
// that tells planes apart.
constexpr double kLeastParallax = 0.15;

// Way along a raster per way before it, from its middle towards a photo.
Eigen::Vector2d SlantOf(const SurveyPhoto& photo, const TexelGrid& raster);

// A photo that takes part: its brightness, about as fine as a raster.
struct SweepPhoto {
  const SurveyPhoto* photo = nullptr;
  cv::Mat grey;               // floats
  Eigen::Vector2d scale;      // its pixels per pixel of the photo
  std::vector<uint8_t> sees;  // by cell
};

SweepPhoto OpenForSweep(const SurveyPhoto& photo, const TexelGrid& raster, PhotoCache& cache);

// How well pairs of photos agree on planes parallel to a raster's: normalised cross-correlation of
// windows, -1 to 1, drawn to 0 where few pairs show a place.
struct PlaneSweep {
  TexelGrid raster;
  double step = 0;  // metres between planes
  int plane = 0;    // the raster's own
  int planes = 0;
  std::vector<Eigen::Vector2d> slants;  // of the photos, see SlantOf
  // [plane * cells + cell]
  std::vector<float> best;      // mean of the better pairs
  std::vector<float> all;       // of all
  std::vector<float> squarest;  // of those with the photo that sees the cell most squarely
  std::vector<float> closest;   // the best pair
  std::vector<uint8_t> pairs;   // how many show the cell on the raster's own plane

  double HeightOf(int label) const { return (label - plane) * step; }
};

// Planes from `deepest` behind to `highest` before the raster's, as far apart as the pair that sees
// them from the most different sides can tell, at most `most_planes` (Collins, "A space-sweep
// approach to true multi-image matching", 1996). Nothing where no two photos look from different
// enough sides.
std::optional<PlaneSweep> SweepPlanes(const TexelGrid& raster,
                                      const std::vector<SweepPhoto>& photos);

// About what a sweep over the raster with so many photos holds at once, bytes.
uint64_t PlaneSweepBytes(const TexelGrid& raster, size_t photos);

}  // namespace stucco
