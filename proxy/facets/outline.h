// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <vector>

#include "proxy/facets/arrangement.h"
#include "proxy/facets/raster.h"

namespace stucco {

struct OutlineOptions {
  double detail = 0;       // world units: a border is worth this much area per length
  double min_area = 0;     // smaller polygons and holes are dropped
  double epsilon = 0;      // seen strips up to this wide along creases may be another plane's
  double reach = 0;        // unknown strips up to this wide between seen cells and creases are free
  double free_length = 0;  // shorter borders run along axes or creases
  bool follow_creases = true;  // short borders may run parallel to creases
  int most_lines = 48;
};

// The outline of what a plane shows, made of creases (intersections with other planes) and of lines
// along the contour of the seen part: the arrangement of all these lines, its faces labelled inside
// or outside by a minimum cut between evidence and length of the border, where borders on creases
// are cheap (compare Fang, Lafarge, Desbrun, "Planar shape detection at structural scales", 2018,
// and Bauchet and Lafarge, "KIPPI", 2018, which cut pictures alike). Polygons are simple by
// construction.
// `to_seen` is the distance of each cell to the nearest seen one.
std::vector<Polygon> Outline(const PlaneRaster& raster, const std::vector<Evidence>& known,
                             const std::vector<float>& to_seen, const std::vector<CutLine>& creases,
                             const OutlineOptions& options);

}  // namespace stucco
