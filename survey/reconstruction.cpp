// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "survey/reconstruction.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>

namespace stucco {
namespace {

constexpr double kQuaternionTolerance = 1e-6;

std::optional<std::string> FindPhotoProblem(const Reconstruction& reconstruction,
                                            const RegisteredImage& photo) {
  if (!reconstruction.cameras.contains(photo.camera)) {
    return fmt::format("uses camera {}, which is missing", photo.camera.value);
  }
  const Pose& pose = photo.cam_from_world;
  if (!pose.translation.allFinite() ||
      !(std::abs(pose.rotation.norm() - 1) <= kQuaternionTolerance)) {
    return "has no valid pose";
  }
  for (size_t i = 0; i < photo.observations.size(); ++i) {
    const Observation& observation = photo.observations[i];
    if (!observation.pixel.allFinite()) return fmt::format("observation {} is not finite", i);
    if (observation.point.IsValid() && !reconstruction.points.contains(observation.point)) {
      return fmt::format("observation {} is of point {}, which is missing", i,
                         observation.point.value);
    }
  }
  return std::nullopt;
}

std::optional<std::string> FindPointProblem(const Reconstruction& reconstruction,
                                            const TrackPoint& point) {
  if (!point.position.allFinite()) return "has no finite position";
  for (const TrackElement& element : point.track) {
    const auto photo = reconstruction.photos.find(element.photo);
    if (photo == reconstruction.photos.end()) {
      return fmt::format("is seen in photo {}, which is missing", element.photo.value);
    }
    const auto& observations = photo->second.observations;
    if (element.observation >= observations.size()) {
      return fmt::format("is observation {} of photo {}, which has {}", element.observation,
                         element.photo.value, observations.size());
    }
    if (observations[element.observation].point != point.id) {
      return fmt::format("is observation {} of photo {}, which says otherwise", element.observation,
                         element.photo.value);
    }
  }
  std::vector<TrackElement> track = point.track;
  std::ranges::sort(track);
  if (std::ranges::adjacent_find(track) != track.end()) return "lists an observation twice";
  return std::nullopt;
}

// Every track element was found among the observations, each once; then equal numbers mean that no
// observation is missing from its point's track.
std::optional<std::string> FindUntrackedObservation(const Reconstruction& reconstruction) {
  size_t tracked = 0;
  for (const auto& [id, point] : reconstruction.points) tracked += point.track.size();
  size_t observed = 0;
  for (const auto& [id, photo] : reconstruction.photos) {
    observed += std::ranges::count_if(photo.observations,
                                      [](const Observation& o) { return o.point.IsValid(); });
  }
  if (observed == tracked) return std::nullopt;
  return fmt::format("{} observations have a point, but tracks list {}", observed, tracked);
}

}  // namespace

std::optional<std::string> FindProblem(const Reconstruction& reconstruction) {
  for (const auto& [id, camera] : reconstruction.cameras) {
    if (camera.id != id) return fmt::format("camera {} is stored under another id", id.value);
    if (const auto problem = FindProblem(camera)) {
      return fmt::format("camera {}: {}", id.value, *problem);
    }
  }
  std::set<std::string_view> names;
  for (const auto& [id, photo] : reconstruction.photos) {
    if (photo.id != id) return fmt::format("photo {} is stored under another id", id.value);
    if (!names.insert(photo.name).second) return fmt::format("two photos are named {}", photo.name);
    if (const auto problem = FindPhotoProblem(reconstruction, photo)) {
      return fmt::format("photo {} ({}) {}", id.value, photo.name, *problem);
    }
  }
  for (const auto& [id, point] : reconstruction.points) {
    if (point.id != id) return fmt::format("point {} is stored under another id", id.value);
    if (const auto problem = FindPointProblem(reconstruction, point)) {
      return fmt::format("point {} {}", id.value, *problem);
    }
  }
  return FindUntrackedObservation(reconstruction);
}

void Transform(const Similarity& new_from_old, Reconstruction& reconstruction) {
  for (auto& [id, photo] : reconstruction.photos) {
    photo.cam_from_world = Transformed(photo.cam_from_world, new_from_old);
  }
  for (auto& [id, point] : reconstruction.points) point.position = new_from_old * point.position;
}

double MeanReprojectionError(const Reconstruction& reconstruction) {
  double sum_px = 0;
  size_t count = 0;
  for (const auto& [id, point] : reconstruction.points) {
    for (const TrackElement& element : point.track) {
      const RegisteredImage& photo = reconstruction.photos.at(element.photo);
      const Camera& camera = reconstruction.cameras.at(photo.camera);
      const auto pixel = camera.Project(photo.cam_from_world * point.position);
      if (!pixel) continue;  // behind the camera there is no distance
      sum_px += (*pixel - photo.observations.at(element.observation).pixel).norm();
      ++count;
    }
  }
  return count == 0 ? 0 : sum_px / static_cast<double>(count);
}

double MeanTrackLength(const Reconstruction& reconstruction) {
  if (reconstruction.points.empty()) return 0;
  size_t sum = 0;
  for (const auto& [id, point] : reconstruction.points) sum += point.track.size();
  return static_cast<double>(sum) / static_cast<double>(reconstruction.points.size());
}

}  // namespace stucco
