// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace stucco {
namespace {

// Of blobs so many times the standard deviation of a sharp keypoint in size, pixels and size tell
// as much of how far off the place may be: a simulated flight against its true poses. Real sets
// show more, but only against their own points (docs/benchmarks.md).
constexpr double kBlobsOfSigma = 3.2;

bool HasCamera(const Scene& scene, const ScenePhoto& photo) {
  return photo.camera >= 0 && static_cast<size_t>(photo.camera) < scene.cameras.size();
}

bool HasBlobs(const ScenePhoto& photo) {
  return photo.blobs_px.empty() || photo.blobs_px.size() == photo.keypoints.size();
}

// One per photo at most.
bool HasKeypoints(const Scene& scene, const SceneTrack& track) {
  std::vector<int> photos;
  for (const SceneElement& element : track.elements) {
    if (element.photo < 0 || static_cast<size_t>(element.photo) >= scene.photos.size())
      return false;
    const ScenePhoto& photo = scene.photos[element.photo];
    if (element.keypoint < 0 || static_cast<size_t>(element.keypoint) >= photo.keypoints.size()) {
      return false;
    }
    photos.push_back(element.photo);
  }
  std::ranges::sort(photos);
  return std::ranges::adjacent_find(photos) == photos.end();
}

bool IsIndexed(const Scene& scene) {
  if (scene.tracks_of_photo.size() != scene.photos.size()) return false;
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    const std::vector<int>& tracks = scene.tracks_of_photo[i];
    if (tracks.size() != scene.photos[i].keypoints.size()) return false;
    const int num_tracks = static_cast<int>(scene.tracks.size());
    if (std::ranges::any_of(tracks, [&](int t) { return t < -1 || t >= num_tracks; })) return false;
  }
  return true;
}

}  // namespace

double ScenePhoto::KeypointSigma(int keypoint) const {
  if (blobs_px.empty()) return keypoint_sigma_px;
  return std::hypot(keypoint_sigma_px, blobs_px[keypoint] / kBlobsOfSigma);
}

std::optional<Pose> RecordedPose(const ScenePhoto& photo) {
  if (!photo.prior || !photo.attitude) return std::nullopt;
  const Eigen::Quaterniond& rotation = photo.attitude->cam_from_world;
  return Pose{rotation, -(rotation * photo.prior->position)};
}

double ReprojectionError(const Scene& scene, const SceneElement& element,
                         const Eigen::Vector3d& point) {
  const ScenePhoto& photo = scene.photos[element.photo];
  if (!photo.pose) return std::numeric_limits<double>::infinity();
  const auto pixel = scene.CameraOf(element.photo).Project(*photo.pose * point);
  if (!pixel) return std::numeric_limits<double>::infinity();
  return (*pixel - photo.keypoints[element.keypoint]).norm();
}

double ReprojectionErrorInSigmas(const Scene& scene, const SceneElement& element,
                                 const Eigen::Vector3d& point) {
  return ReprojectionError(scene, element, point) / scene.photos[element.photo].keypoint_sigma_px;
}

bool IsConsistent(const Scene& scene) {
  return std::ranges::all_of(
             scene.photos,
             [&](const ScenePhoto& photo) { return HasCamera(scene, photo) && HasBlobs(photo); }) &&
         std::ranges::all_of(scene.tracks,
                             [&](const SceneTrack& track) { return HasKeypoints(scene, track); }) &&
         (scene.tracks_of_photo.empty() || IsIndexed(scene));
}

int NumRegistered(const Scene& scene) {
  return static_cast<int>(std::count_if(scene.photos.begin(), scene.photos.end(),
                                        [](const ScenePhoto& p) { return p.pose.has_value(); }));
}

std::vector<int> TracksOf(const Scene& scene, const std::vector<int>& photos) {
  std::vector<int> tracks;
  for (const int photo : photos) {
    for (const int track : scene.tracks_of_photo[photo]) {
      if (track >= 0) tracks.push_back(track);
    }
  }
  std::ranges::sort(tracks);
  tracks.erase(std::unique(tracks.begin(), tracks.end()), tracks.end());
  return tracks;
}

std::vector<int> TracksSeenBy(const Scene& scene, int photo) {
  std::vector<int> seen;
  for (const int index : scene.tracks_of_photo[photo]) {
    if (index < 0 || !scene.tracks[index].position) continue;
    const bool agrees =
        std::ranges::any_of(scene.tracks[index].elements,
                            [&](const SceneElement& e) { return e.photo == photo && e.used; });
    if (agrees) seen.push_back(index);
  }
  return seen;
}

std::vector<int> PointsShared(const Scene& scene, int photo) {
  std::vector<int> shared(scene.photos.size(), 0);
  for (const int track : TracksSeenBy(scene, photo)) {
    for (const SceneElement& e : scene.tracks[track].elements) shared[e.photo] += e.used;
  }
  shared[photo] = 0;
  return shared;
}

int NumUsedObservations(const Scene& scene, int photo) {
  return static_cast<int>(TracksSeenBy(scene, photo).size());
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
