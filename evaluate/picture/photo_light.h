// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <array>
#include <vector>

#include "survey/camera.h"

namespace stucco::evaluate {

// Squared distance from the principal point, 1 in the farthest corner.
double RadiusSquared(const Camera& camera, double x_px, double y_px);

// How a lens darkens its picture towards the corners: light times exp(square r^2 + fourth r^4).
struct Falloff {
  double square = 0;
  double fourth = 0;

  double At(double radius_squared) const;
};

// One place of a photo: the logarithms of its light over the model's.
struct LightSample {
  std::array<double, 3> log_ratios;
  double radius_squared = 0;
};

// What photos of one camera did with the light that the model promises.
struct PhotoLight {
  std::vector<std::array<double, 3>> gains;  // by photo: exposure and white balance
  Falloff falloff;                           // of the lens, the same in all photos
};

// Least absolute deviations of the logarithms, so that places where model and photo differ have
// little say. Photos without samples have gains of 1.
PhotoLight FitPhotoLight(const std::vector<std::vector<LightSample>>& photos);

}  // namespace stucco::evaluate
