// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "simulate/render/pictures.h"
#include "survey/camera.h"

namespace stucco::simulate {

// The lens's blur: a Gaussian of this standard deviation. Below 0.7 pixels, where a sampled
// Gaussian would be too narrow, three weights of exactly its variance take its place.
void BlurByFocus(double sigma_px, int threads, Radiance& picture);

// The blur of a camera that turns by `turn_rad` (about its x, y and z axes) while the shutter is
// open, at constant speed: each pixel is averaged along its own way through the picture. A hovering
// drone's drift, a tenth of a millimetre in a thousandth of a second, adds nothing to it.
void BlurByTurning(const Camera& camera, const Eigen::Vector3d& turn_rad, int threads,
                   Radiance& picture);

// How far what is at `pixel` moves while the camera turns; 0 where the lens has no ray.
Eigen::Vector2d ImageMotion(const Camera& camera, const Eigen::Vector3d& turn_rad,
                            const Eigen::Vector2d& pixel);

}  // namespace stucco::simulate
