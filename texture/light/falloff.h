// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>

#include "survey/camera.h"
#include "survey/image.h"

namespace stucco {

// How a lens darkens its pictures towards their corners: at `share`, the squared distance from the
// principal point next to that of the farthest corner, codes are exp(terms . (share, share^2))
// times those of the middle (as the even polynomials of Goldman, "Vignette and exposure calibration
// and compensation", PAMI 2010, in logarithms and of codes instead of light: what cameras make of
// light is nearer to a power, which keeps factors, than to the curve of sRGB with its foot).
struct Falloff {
  Eigen::Vector2d terms = Eigen::Vector2d::Zero();

  bool IsNone() const { return terms.isZero(0); }
  double LogAt(double share) const { return share * (terms[0] + share * terms[1]); }
};

double CornerShare(const Camera& camera, const Eigen::Vector2d& pixel);

// Brings a photo of the camera, in whatever size, to the light of its middle.
void EvenOut(const Falloff& falloff, const Camera& camera, Image& picture);

}  // namespace stucco
