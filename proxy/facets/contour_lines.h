// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/facets/raster.h"

namespace stucco {

struct ContourOptions {
  double detail = 0;           // edges shorter than three times this are ignored
  int most_lines = 48;         // the longest ones are kept
  double axis_deg = 14;        // edges this near to an axis of the frame are laid along it
  double crease_deg = 8;       // edges this near to a crease's direction are laid along it
  bool follow_creases = true;  // false: short edges take no crease's direction
  double free_length =
      0;  // shorter edges are laid along the nearest axis within 30 degrees, or left
};

// Lines along the straight edges of the raster's seen and closed part (its contours simplified by
// Douglas and Peucker, 1973), without those that repeat a crease or a longer line.
std::vector<CutLine> ContourLines(const PlaneRaster& raster, const std::vector<Evidence>& evidence,
                                  const std::vector<CutLine>& creases,
                                  const ContourOptions& options);

}  // namespace stucco
