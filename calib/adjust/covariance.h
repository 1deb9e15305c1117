// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <Eigen/Core>
#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

struct PoseSigma {
  double position = -1;      // unit of the scene, root of the sum over the axes; -1: not computed
  double rotation_rad = -1;  // likewise
  // How far it moves the photo's own points in its picture, pixels in full size: the middle one of
  // the points' root mean squares. Where a turn, a shift and the lens make up for each other they
  // do no harm there; and points that a photo shares with one from the same place alone may end up
  // right before the lens, where any shift is without limit, but hold nothing and harm nothing.
  double picture_px = -1;
};

struct SceneSigmas {
  std::vector<Eigen::VectorXd> intrinsics;  // by camera, 0 where held; empty: not computed
  std::vector<PoseSigma> poses;             // by photo
};

struct SigmaOptions {
  // With more registered photos intrinsics are not computed, and poses with all points held: each
  // photo's own part of the error.
  int max_photos = 10000;
  bool use_priors = false;  // took part in the adjustment
  // Points were held: intrinsics are not computed, and poses as if these were known.
  bool points_are_given = false;
  std::vector<int> tracks = {};  // that did, by index; empty: all that have a point
  int threads = 1;
};

// One standard deviation of what an adjustment of everything found, from its normal equations with
// points eliminated (Schur complement; Triggs et al. 2000, section 6.3) and the scatter of the
// residuals as a robust estimator sees it (Huber, "Robust Statistics", 1981, section 7.6), of which
// neighbours in a picture may share a part. Two estimates are made, and the larger one is told: as
// if all keypoints were equally good, which holds where few of them say little of how good they
// are; and with each residual as it is (sandwich estimator: Huber 1967; White 1980), since photos
// that look at a place from very different sides match it less well than the others, and what hangs
// on the rest by these is less sure than all residuals together say. Both are shown by random draws
// (Draws), good to some 4 %. Poses are those of the model in itself:
// what a similarity of all photos' places takes away is left out (S-transformation: Baarda 1973),
// so that the frame that the system was solved in does not matter. Nothing is computed where the
// system is singular.
SceneSigmas EstimateSigmas(const SigmaOptions& options, const Scene& scene);

}  // namespace stucco
