// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <span>
#include <vector>

#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/photos/photo_cache.h"
#include "texture/relief/best_rectangle.h"

namespace stucco {

// Photos from nearly the same side show the same on any plane: the least difference of their slants
// that tells planes apart.
constexpr double kLeastParallax = 0.15;

// Photos are compared by windows of so many cells a side, which reach so far from their middle.
constexpr int kSweepWindow = 7;
constexpr int kReach = kSweepWindow / 2;

// Way along a raster per way before it, from its middle towards a photo.
Eigen::Vector2d SlantOf(const SurveyPhoto& photo, const TexelGrid& raster);

// The largest difference of the slants of two photos that tell planes apart; 0 where none do.
double LargestParallax(std::span<const Eigen::Vector2d> slants);

// The cells with those around them that windows at their rim reach, and the raster of a part.
CellRectangle WithRim(const CellRectangle& cells, const TexelGrid& raster);
TexelGrid PartOf(const TexelGrid& raster, const CellRectangle& cells);

// A photo that takes part: its brightness, about as fine as a raster.
struct SweepPhoto {
  const SurveyPhoto* photo = nullptr;
  cv::Mat grey;               // floats
  Eigen::Vector2d scale;      // its pixels per pixel of the photo
  std::vector<uint8_t> sees;  // by cell of the part of the raster, with its rim
};

SweepPhoto OpenForSweep(const SurveyPhoto& photo, const TexelGrid& part, PhotoCache& cache);

// Whether photos show anything but noise about a cell.
enum class Plain : uint8_t {
  kNot,
  kHere,    // nothing next to the cell
  kAround,  // nothing in its window
};

// How well pairs of photos agree on planes parallel to a raster's: normalised cross-correlation of
// windows, -1 to 1, drawn to 0 where few pairs show a place.
struct PlaneSweep {
  TexelGrid raster;
  double step = 0;  // metres between planes
  int plane = 0;    // the raster's own
  int planes = 0;
  // [plane * cells + cell]
  std::vector<float> best;      // mean of the better pairs
  std::vector<float> all;       // of all
  std::vector<float> squarest;  // of those with the photo that sees the cell most squarely
  std::vector<float> closest;   // the best pair
  std::vector<Plain> plain;     // in all pairs
  std::vector<uint8_t> pairs;   // how many show the cell on the raster's own plane
  // Mean brightness there, 0 to 255, of the photos that show the cell; below 0: none does. What is
  // on the plane is sharp in it, what is not is blurred.
  std::vector<float> grey;

  double HeightOf(int label) const { return (label - plane) * step; }
};

// Nothing swept yet: planes from `deepest` behind to `highest` before the raster's, as far apart as
// a pair of that parallax can tell, at most `most_planes`. Requires parallax > 0.
PlaneSweep StartSweep(const TexelGrid& raster, double parallax);

// Compares the photos in a part of the raster (Collins, "A space-sweep approach to true multi-image
// matching", 1996). Parts apart from each other may be swept one after the other with photos of
// their own.
void SweepPart(const CellRectangle& cells, const std::vector<SweepPhoto>& photos,
               PlaneSweep& sweep);

// About what a sweep over the raster holds at once, bytes.
uint64_t PlaneSweepBytes(const TexelGrid& raster);

}  // namespace stucco
