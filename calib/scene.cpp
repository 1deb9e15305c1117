// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stucco {

double ReprojectionError(const Scene& scene, const SceneElement& element,
                         const Eigen::Vector3d& point) {
  const ScenePhoto& photo = scene.photos[element.photo];
  if (!photo.pose) return std::numeric_limits<double>::infinity();
  const auto pixel = scene.CameraOf(element.photo).Project(*photo.pose * point);
  if (!pixel) return std::numeric_limits<double>::infinity();
  return (*pixel - photo.keypoints[element.keypoint]).norm();
}

double Misfit(const Scene& scene, const SceneElement& element, const Eigen::Vector3d& point) {
  return ReprojectionError(scene, element, point) / scene.photos[element.photo].keypoint_sigma_px;
}

int NumPosed(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.photos.begin(), scene.photos.end(),
                                        [](const ScenePhoto& p) { return p.pose.has_value(); }));
}

int NumUsedObservations(const Scene& scene, int photo) {
  int count = 0;
  for (const int track_index : scene.tracks_of_photo[photo]) {
    if (track_index < 0) continue;
    const SceneTrack& track = scene.tracks[track_index];
    if (!track.position) continue;
    for (const SceneElement& element : track.elements) {
      if (element.photo == photo && element.used) ++count;
    }
  }
  return count;
}

double LargestRayAngle(const Scene& scene, const SceneTrack& track) {
  double smallest_cos = 1;
  std::vector<Eigen::Vector3d> rays;
  for (const SceneElement& element : track.elements) {
    if (!element.used || !scene.photos[element.photo].pose) continue;
    const Eigen::Vector3d ray =
        (*track.position - scene.photos[element.photo].pose->Center()).normalized();
    for (const Eigen::Vector3d& other : rays) smallest_cos = std::min(smallest_cos, ray.dot(other));
    rays.push_back(ray);
  }
  return std::acos(std::clamp(smallest_cos, -1.0, 1.0));
}

}  // namespace stucco
