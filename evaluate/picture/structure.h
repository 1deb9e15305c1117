// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "evaluate/picture/picture_pair.h"

namespace stucco::evaluate {

// All on luma (Rec. 601, of sRGB codes from 0 to 255), over the windows that lie in the picture and
// in the mask as a whole; kNotMeasured where there is no such window.

// Mean structural similarity (Wang, Bovik, Sheikh, Simoncelli: "Image Quality Assessment: From
// Error Visibility to Structural Similarity", 2004): Gaussian windows of 11 x 11 pixels, sigma 1.5,
// K1 = 0.01, K2 = 0.03. 1 for equal pictures.
double Ssim(const PicturePair& pair);

// Multi-scale SSIM (Wang, Simoncelli, Bovik: "Multi-scale Structural Similarity for Image Quality
// Assessment", 2003) with its five scales and weights. Halving takes the mean of 2 x 2 pixels, all
// of which must have content. Where the coarser scales have no whole window (a side below 176
// pixels, a mask of small pieces), the measure is taken on the scales that have, with their weights
// divided by their sum. A scale whose contrasts agree less than not at all counts as 0.
double MultiScaleSsim(const PicturePair& pair);

// Gradient magnitude similarity deviation (Xue, Zhang, Mou, Bovik: "Gradient Magnitude Similarity
// Deviation", 2014): the deviation of OpenCV's map of similarities, over the windows of 6 x 6
// pixels that are whole; OpenCV itself counts those that stick out as well. 0 for equal pictures.
double Gmsd(const PicturePair& pair);

// Peak signal-to-noise ratio over the three channels of the pixels in the mask, in dB. At most
// kMaxPsnr_db, which stands for equal pictures too, so that means stay finite.
inline constexpr double kMaxPsnr_db = 100;
double Psnr(const PicturePair& pair);

}  // namespace stucco::evaluate
