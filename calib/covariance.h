// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/scene.h"

namespace stucco {

// Standard deviations of every camera's intrinsics after an adjustment of everything, from the
// inverse of the normal equations with points eliminated (Schur complement; Triggs et al. 2000,
// section 6.3), scaled by the residuals' own variance. Empty when the system is singular or has
// more than `max_photos` photos; 0 for cameras that were held fixed. The frame is held by the first
// pose and the scale.
std::vector<Eigen::VectorXd> IntrinsicsSigma(const Scene& scene, int max_photos = 400);

struct PoseSigma {
  double position = -1;      // unit of the scene, root of the sum over the axes; -1 without a pose
  double rotation_rad = -1;  // likewise
};

// Standard deviation of every pose with the points and intrinsics held: its own part of the error,
// without what it shares with its neighbours. Scaled by the noise that the residuals show.
std::vector<PoseSigma> PoseSigmas(const Scene& scene);

}  // namespace stucco
