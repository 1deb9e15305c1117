// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/results/summary_input.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace stucco {

Reconstruction ToReconstruction(const Scene& scene, const std::vector<uint32_t>& photo_ids) {
  assert(photo_ids.size() == scene.photos.size());
  Reconstruction result;
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    const ScenePhoto& photo = scene.photos[i];
    if (!photo.pose) continue;
    const Camera& camera = scene.CameraOf(static_cast<int>(i));
    result.cameras[camera.id] = camera;
    RegisteredImage& registered = result.photos[PhotoId{photo_ids[i]}];
    registered.id = PhotoId{photo_ids[i]};
    registered.camera = camera.id;
    registered.name = photo.name;
    registered.cam_from_world = *photo.pose;
  }
  uint64_t next = 1;
  for (const SceneTrack& track : scene.tracks) {
    // The last filtering may have taken a pose, and with it all but one view of a point.
    const auto used = std::count_if(track.elements.begin(), track.elements.end(),
                                    [](const SceneElement& e) { return e.used; });
    if (!track.position || used < 2) continue;
    TrackPoint point;
    point.id = PointId{next++};
    point.position = *track.position;
    double error = 0;
    for (const SceneElement& element : track.elements) {
      if (!element.used) continue;
      const ScenePhoto& photo = scene.photos[element.photo];
      RegisteredImage& registered = result.photos.at(PhotoId{photo_ids[element.photo]});
      if (point.track.empty()) point.rgb = photo.colors[element.keypoint];
      point.track.push_back({registered.id, static_cast<uint32_t>(registered.observations.size())});
      registered.observations.push_back({photo.keypoints[element.keypoint], point.id});
      error += ReprojectionError(scene, element, point.position);
    }
    point.error_px = error / static_cast<double>(point.track.size());
    result.points[point.id] = std::move(point);
  }
  return result;
}

std::vector<uint32_t> PhotoIds(const SummaryInput& input) {
  std::vector<uint32_t> ids;
  for (const int capture : input.capture_of_photo) {
    ids.push_back(static_cast<uint32_t>(capture) + 1);
  }
  return ids;
}

}  // namespace stucco
