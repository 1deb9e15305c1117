// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/image.h"
#include "survey/survey_photo.h"
#include "texture/grid/grid.h"
#include "texture/views/candidates.h"

namespace stucco {

// The planner's four terms for a facet, measured on what was painted; each in [0, 1].
//   w_j    share of the painted texels that photo j painted
//   s_j    mean direction from photo j's camera to its texels, m the facet's inward normal
//   g(x)   size of a photo pixel on the facet at texel x, g0 the wanted size (the texel's)
//   Q_s = 1/2 ( mean over texels of max(0, s(x).m)  +  | sum w_j s_j | )   frontal, like-minded
//   Q_d = 1/2 ( mean of min(1, g0 / g)  +  1 - min(1, std(g) / mean(g)) )  close, evenly so
//   Q_u = painted area / sum over the used photos of the area they see     few photos per texel
//   Q_c = painted area / area                                              complete
struct AchievedQuality {
  double q_s = 0;
  double q_d = 0;
  double q_u = 0;
  double q_c = 0;
  double footprint = 0;  // median of g, world units
};

// `views` are the used photos over the raster, `owner` the index of the view that painted a texel
// (-1: none), `texel` the wanted pixel size.
AchievedQuality MeasureQuality(std::span<const RasterView> views,
                               std::span<const SurveyPhoto> photos, const FacetRaster& raster,
                               std::span<const int> owner, double texel);

// Variance of the Laplacian of the grey picture (4 neighbours, grey 0 to 255) over the texels that,
// with their neighbours, were painted from photos. 0 when there is none.
double MeasureSharpness(const Image& picture, const std::vector<uint8_t>& painted);

}  // namespace stucco
