// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "texture/light/colour.h"
#include "texture/light/falloff.h"

namespace stucco {

// What brings photos to one light.
struct PhotosLight {
  std::vector<Eigen::Vector3d> gains;  // by photo and channel, of codes
  std::vector<Falloff> falloffs;       // by photo, of its lens
};

// Gains that make the photos agree, and the falloffs of their lenses: least squares on the
// logarithms over all overlaps of the whole model, with Huber weights, drawn to no gain and no
// falloff (Brown & Lowe, "Automatic Panoramic Image Stitching using Invariant Features", 2007, on
// ratios). Hues that only one photo has are held near those of the others. Photos without overlap
// keep 1. A falloff that is no more than three of its own standard deviations is none.
// `camera_of_photo` numbers the lenses from 0. Requires ratios of those photos.
PhotosLight SolveLight(std::span<const ColourRatio> ratios, std::span<const int> camera_of_photo);

}  // namespace stucco
