// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#pragma once

#include <optional>
#include <vector>

#include "calib/scene/scene.h"

namespace stucco {

struct Resection {
  Pose cam_from_world;
  int num_inliers = 0;
  int num_points = 0;  // keypoints whose track has a point
};

// Pose of a photo from the points its keypoints show: P3P in USAC (MAGSAC score), refined on the
// inliers. Nothing when fewer than `min_inliers` agree within `max_error_px` (full-resolution
// pixels). These three require a scene whose tracks are indexed (IndexTracks).
std::optional<Resection> Resect(const Scene& scene, int photo, double max_error_px,
                                int min_inliers);

// Number of keypoints of a photo whose track has a point.
int NumVisiblePoints(const Scene& scene, int photo);

// The same, weighted by how they spread over the image (sum over grids of 2, 4, 8, 16 cells a side
// of the number of filled cells times the cells' side count; Schoenberger & Frahm 2016).
int VisibilityScore(const Scene& scene, int photo);

}  // namespace stucco
