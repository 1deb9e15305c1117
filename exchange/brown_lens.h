// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include "survey/camera.h"
#include "survey/pixels.h"

namespace stucco {

// What every camera model of ours is a case of, each number by its name. Tangential terms are in
// OpenCV's order: x' = ... + 2 p1 x y + p2 (r^2 + 2 x^2). Pixels as in camera.h.
struct BrownLens {
  double fx = 0, fy = 0, cx = 0, cy = 0;
  double k1 = 0, k2 = 0, k3 = 0;  // of r^2, r^4, r^6
  double p1 = 0, p2 = 0;
  double k4 = 0, k5 = 0, k6 = 0;  // of the denominator
};

BrownLens LensWithNames(const Camera& camera);

// The model with the fewest parameters that is this lens exactly. The camera has no id.
Camera CameraWithLens(const BrownLens& lens, const ImageSize& size);

}  // namespace stucco
