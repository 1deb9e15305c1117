// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "texture/grid/grid.h"
#include "texture/selection/consensus.h"
#include "texture/selection/label_cut.h"

namespace stucco {

struct SelectOptions {
  int cell = 4;  // side of a cell in raster texels
  double photo_cost = 0.03;
  double seam_cost = 1;
  double min_region = 0.01;
  double relief = 0;  // of the facade, before and behind its plane, in raster texels
};

// Gives connected regions of fewer than `min_cells` cells to the neighbour they share most of their
// border with, where that photo can paint them.
void MergeSmallRegions(const LabelProblem& problem, size_t min_cells, Labels& labels);

// The picture for each raster texel: index into `pictures`, -1 where none sees it. Few pictures, in
// large regions; texels that the picture of their cell does not see take the best of the others in
// use.
std::vector<int> SelectPictures(std::span<const RasterPicture> pictures, const FacetRaster& raster,
                                const SelectOptions& options);

}  // namespace stucco
