// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/pair_rays.h"

namespace stucco {

PairRays RaysOf(const Scene& scene, const PhotoPair& pair, double max_error_sigmas, size_t most) {
  PairRays rays;
  const Camera& camera_a = scene.CameraOf(pair.first);
  const Camera& camera_b = scene.CameraOf(pair.second);
  const size_t step = pair.matches.size() / most + 1;
  for (size_t i = 0; i < pair.matches.size(); i += step) {
    const Match& match = pair.matches[i];
    const auto a = camera_a.Unproject(scene.photos[pair.first].keypoints[match.first]);
    const auto b = camera_b.Unproject(scene.photos[pair.second].keypoints[match.second]);
    if (!a || !b) continue;
    rays.first.push_back(*a);
    rays.second.push_back(*b);
  }
  const double sigma_a = scene.photos[pair.first].keypoint_sigma_px / camera_a.FocalX();
  const double sigma_b = scene.photos[pair.second].keypoint_sigma_px / camera_b.FocalX();
  rays.max_error = max_error_sigmas * (sigma_a + sigma_b) / 2;
  return rays;
}

}  // namespace stucco
