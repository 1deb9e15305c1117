// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "proxy/cloud/samples.h"
#include "proxy/planes/plane.h"

namespace stucco {

// What is known about the parts of a plane, on a grid of its frame. Cell (x, y) has its centre at
// origin + (x + 0.5, y + 0.5) * cell in plane coordinates.
struct PlaneRaster {
  PlaneFrame frame;
  Eigen::Vector2d origin = Eigen::Vector2d::Zero();
  double cell = 0;
  int width = 0;
  int height = 0;
  std::vector<uint8_t> hits;     // points of the plane, counted up to 255
  std::vector<uint8_t> through;  // rays that pass to points behind the plane, up to 255

  size_t Index(int x, int y) const { return static_cast<size_t>(y) * width + x; }
  Eigen::Vector2d Center(int x, int y) const {
    return origin + cell * Eigen::Vector2d(x + 0.5, y + 0.5);
  }
  // -1 outside.
  int IndexAt(const Eigen::Vector2d& point) const;
  bool IsSeen(size_t i) const { return hits[i] > 0; }
  bool IsOpen(size_t i) const { return hits[i] == 0 && through[i] >= 2; }
};

// Grid over the plane's points and `margin` around them; `cell` grows where the grid would be wider
// than 1500 cells.
PlaneRaster RasteriseHits(const Samples& samples, const Plane& plane, const PlaneFrame& frame,
                          double cell, double margin);

// Counts the rays from cameras to `support` (samples that lie on some plane) that pass through
// the plane and end more than `behind` behind it: there the wall has an opening, or ends.
void CountThroughRays(const Samples& samples, const std::vector<int>& support, const Plane& plane,
                      double behind, PlaneRaster& raster);

// From each cell to the nearest of those that are not 0, in the raster's unit; far beyond its size
// where none is.
std::vector<float> DistancesTo(const PlaneRaster& raster, const std::vector<char>& cells);

// The states of a raster's cells for outlining.
enum class Evidence : uint8_t { kUnknown, kSeen, kGap, kOpen, kBetween };

// Seen cells (single holes between points closed), gaps (unseen cells that closing with `fill_gap`
// reaches or that seen cells enclose), openings (see through, but for small ones enclosed by wall:
// windows), the rest unknown (Outline turns
// those between seen cells and a crease to kBetween). Islands of seen cells smaller than `min_area`
// are unknown.
std::vector<Evidence> Classify(const PlaneRaster& raster, double fill_gap, double min_area);

// Unknown cells between seen ones become gaps: those with seen cells above and below within
// `reach`, and those with seen cells on both sides within `reach` and anywhere above (what stands
// in front of a wall hides its foot; the sky between two gables has nothing above). Requires a
// frame whose v points upwards, and a piece of evidence for every cell.
void FillBays(const PlaneRaster& raster, double reach, std::vector<Evidence>& evidence);

}  // namespace stucco
