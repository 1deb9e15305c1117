// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "texture/grid/grid.h"
#include "texture/views/candidates.h"

namespace stucco {

// A candidate over the selection raster of a facet: how it sees each texel and what it shows there.
struct RasterPicture {
  std::vector<Sight> sight;
  std::vector<float> cost;  // ViewCost, which means nothing where not seen
  std::vector<float>
      rgb;  // 3 per texel, 0 to 255, after colour gains; means nothing where not seen
  // Of the photo over the raster: column and row of its foot and height, all in texels. Height 0:
  // not known.
  Eigen::Vector3d camera = Eigen::Vector3d::Zero();
};

// Mean of the channels.
float Brightness(const float* rgb);

// Root mean square over the channels of two colours.
float ColourDifference(const float* a, const float* b);

// What most pictures show: per texel the median colour of those that see it freely (of all that see
// it when fewer than three do) and their number.
struct Consensus {
  std::vector<float> rgb;  // 3 per texel
  std::vector<int> count;
};

Consensus FindConsensus(std::span<const RasterPicture> pictures, const TexelGrid& raster);

// How far each picture is from the consensus, per texel, 0 (agrees) to 1: forgiving near edges,
// where a little misregistration is enough to differ. 0 where fewer than three see a texel: nobody
// knows who is right.
std::vector<std::vector<float>> Disagreement(std::span<const RasterPicture> pictures,
                                             const Consensus& consensus, const TexelGrid& raster);

// Lowers disagreement that relief explains. Photos that look from elsewhere show it elsewhere, so
// that many tilted ones, alike among themselves, would outvote the one that looks straight: a
// picture agrees with the others where they show the same of some point up to `relief` texels
// before or behind the plane. Pictures whose camera is not known keep theirs.
void ForgiveRelief(std::span<const RasterPicture> pictures, const Consensus& consensus,
                   const TexelGrid& raster, double relief,
                   std::vector<std::vector<float>>& disagreement);

// The share of the consensus's contrast that a picture lacks, 0 to 1: haze, lens flare, blur. The
// slope of its brightness against the consensus's where they show the same thing; 0 with fewer than
// 50 such texels or hardly any contrast.
float Haze(const RasterPicture& picture, const Consensus& consensus,
           const std::vector<float>& disagreement);

}  // namespace stucco
