// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/proxy.h"
#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/views/visibility.h"

namespace stucco {

// How one photo sees one texel of a raster.
enum class Sight : uint8_t {
  kNot = 0,     // outside the picture, behind, at a grazing angle or hidden by another facet
  kBeyond = 1,  // the photo looks past the real surface, which ends before the facet does
  kBehind = 2,  // points of the cloud stand in front of the surface here
  kFree = 3,
};

struct TexelView {
  Sight sight = Sight::kNot;
  float resolution = 0;    // photo pixels per texel across the more foreshortened direction
  float footprint = 0;     // side of a photo pixel on the facet (root of its area), world units
  float cos_angle = 0;     // between the facet's normal and the direction to the camera
  bool no_points = false;  // the cloud has nothing here
  float border = 0;        // 1 at the picture's border to 0 at 4 % of its width away from it
};

// One photo over a raster, by row.
struct RasterView {
  int photo = -1;  // index into the photos
  std::vector<TexelView> texels;
};

struct ViewLimits {
  double max_angle_deg = 78;
  // Things nearer to the facet than this belong to it (cornices, window sills, an imprecise
  // proxy): rays start this far in front of it. World units.
  double tolerance = 0;
  double clearance = 0;  // points of the cloud farther in front than this hide it
};

// Measures a photo over the raster texels that are not wholly outside the facet. Where a third of
// the 3 x 3 texels around one are behind points of the cloud, it counts as behind them too: borders
// of trees and of noisy clouds are never exact.
RasterView MeasureView(const SightScene& scene, int photo, const Facet& facet,
                       const FacetRaster& raster, const ViewLimits& limits);

// Badness of a photo for a texel in [0, 1] from geometry and the photo alone: 0.4 resolution
// (against one photo pixel per texel of size `texel`), 0.3 obliqueness, 0.2 sharpness, 0.1 border.
float ViewCost(const TexelView& view, double raster_texel, double texel, double sharpness);

// ViewCost of every texel, 0 where not seen.
std::vector<float> ViewCosts(const RasterView& view, double raster_texel, double texel,
                             double sharpness);

// Of one facet: the labels that say who painted a texel are bytes, and two have other meanings.
inline constexpr int kMostCandidates = 254;

// A photo that can paint part of a facet.
struct Candidate {
  int photo = -1;
  double seen = 0;   // share of the raster it sees
  double merit = 0;  // mean over the raster of 1 - cost where seen
};

// The best photos for a facet: first those that bring the most merit where the ones before left
// most to be wished for, then by merit, `max_count` in all. Photos that show what none of the
// others does come in addition, up to kMostCandidates, so that large facets stay covered. In that
// order.
std::vector<Candidate> RankCandidates(std::span<const RasterView> views,
                                      std::span<const uint16_t> inside,
                                      std::span<const std::vector<float>> costs, int max_count);

// The survey's resolution on a facet: per texel the finest view of any photo (across its more
// foreshortened direction), over the texels the 25th percentile, rounded to two digits, in world
// units. 0 when no photo sees it.
double FinestTexel(std::span<const RasterView> views, double raster_texel);

}  // namespace stucco
