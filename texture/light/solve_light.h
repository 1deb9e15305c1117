// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "texture/light/colour.h"
#include "texture/light/falloff.h"

namespace stucco {

// What is known of a photo beforehand.
struct TakenPhoto {
  int lens = 0;  // numbered from 0
  // Logarithm of its codes beside those of the same light with another exposure of that lens: by
  // its metadata. Nothing: not known.
  std::optional<double> log_exposure;
  std::optional<double> time_h;  // when it was taken, from any start
};

// What brings photos to one light.
struct PhotosLight {
  std::vector<Eigen::Vector3d> gains;  // by photo and channel, of codes
  std::vector<Falloff> falloffs;       // by photo, of its lens
  std::vector<TakenPhoto> photos;      // that these are of
};

// How uncertain it is, in logarithms of codes, that a wall has the same light when so many hours
// have passed: it turns into the sun and out of it. 0 where either time is not known.
double SunSigma(const std::optional<double>& a_h, const std::optional<double>& b_h);

// Gains that make the photos agree, and the falloffs of their lenses: least squares on the
// logarithms over all overlaps of the whole model, with Huber weights, drawn to no falloff, and to
// what exposures say, up to a factor for each lens, or else to no gain (Brown & Lowe, "Automatic
// Panoramic Image Stitching using Invariant Features", 2007, on ratios). What photos of other hours
// differ by says less of their exposures, as the sun has moved between them. Hues that only one
// photo has are held near those of the others. Photos without overlap keep 1. A falloff that is no
// more than three of its own standard deviations is none. Requires ratios of those photos.
PhotosLight SolveLight(std::span<const ColourRatio> ratios, std::span<const TakenPhoto> photos);

}  // namespace stucco
