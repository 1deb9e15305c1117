// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "simulate/render/pictures.h"
#include "survey/camera.h"
#include "survey/image.h"

namespace stucco::simulate {

// How light becomes a picture.
struct SensorEffects {
  double exposure = 1;
  Eigen::Vector3d white_balance = Eigen::Vector3d::Ones();
  double vignetting = 0;                               // light lost in the farthest corner
  double focus_blur_px = 0;                            // standard deviation
  Eigen::Vector3d turn_rad = Eigen::Vector3d::Zero();  // of the camera while the shutter is open
  double noise = 0;  // standard deviation at white, share of white
  uint64_t seed = 0;
  double sharpening = 0;  // as Sharpened takes it
};

// Blurs, darkens towards the corners (by the square of the radius about the principal point),
// exposes, adds noise (shot noise by the square root of the light, and a quarter of the noise at
// white everywhere), balances white, codes the light as a camera's JPEG holds it (CameraCurve), and
// sharpens. The same bytes at any number of threads.
Image Develop(Radiance picture, const Camera& camera, const SensorEffects& effects, int threads);

// The share of the light that arrives at a pixel.
double Vignetting(const Camera& camera, double lost, const Eigen::Vector2d& pixel);

// Linear [0, inf) to [0, 1] as written: straight up to 0.7, rolling off to 1 above (the highlights
// that cameras keep), sRGB, and a slightly steeper middle.
double CameraCurve(double linear);

}  // namespace stucco::simulate
