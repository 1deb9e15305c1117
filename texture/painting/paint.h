// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <vector>

#include "survey/image.h"
#include "survey/proxy.h"
#include "texture/grid/grid.h"
#include "texture/options/texture_options.h"
#include "texture/painting/quality.h"
#include "texture/selection/consensus.h"
#include "texture/views/look.h"

namespace stucco {

struct PaintedFacet {
  TexelGrid grid;
  double wanted_texel = 0;      // smaller than the grid's where its size is limited
  std::vector<uint8_t> mask;    // 1 inside the facet
  Image picture;                // colours go on smoothly outside the facet
  std::vector<uint8_t> labels;  // 1 + index into `photos`, 255 inpainted, 0 outside or empty
  // 1 where what painted a texel is seen in front of the facet: a tree, a car.
  std::vector<uint8_t> in_front;
  std::vector<int> photos;  // indices of the survey's photos, most painted first
  double painted = 0;       // shares of the facet's texels
  double inpainted = 0;
  double misregistration_px = -1;  // after alignment, texels; -1: only one photo
  double misregistration_before_px = -1;
  double sharpness = 0;
  AchievedQuality quality;
};

// About what PaintFacet holds at once, besides the photo cache: the facet's picture, the rasters
// and seams of the selection, those of the alignment, and the photo that is being read in full
// size.
uint64_t PaintingBytes(const Facet& facet, const FacetLook& look, const PaintScene& scene,
                       const TextureOptions& options);

// What a facet's picture was chosen from, for those who want to know why it looks as it does.
struct PaintRecord {
  FacetRaster raster;
  std::vector<int> photos;              // candidates, best first; indices of the survey's photos
  std::vector<RasterPicture> pictures;  // likewise, over the raster
  std::vector<int> owner;               // by raster texel, which candidate paints it; -1: none
  Image unlit;                          // the picture without gains, seams as they fall
};

// What is to be painted from what. Keeps references.
struct PaintJob {
  const Facet& facet;
  const FacetLook& look;
  std::span<const Eigen::Vector3d> gains;  // by photo of the survey
  const PaintScene& scene;
  const TextureOptions& options;
};

// Paints one facet with its candidates: selection, alignment, composition, filling, measures. No
// picture where no texel could be painted. `record`, where one is given, is filled in; it changes
// nothing.
PaintedFacet PaintFacet(const PaintJob& job, PaintRecord* record = nullptr);

}  // namespace stucco
