// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/choose_tracks.h"

#include <algorithm>

namespace stucco {
namespace {

constexpr int kCells = 8;  // a side

// How many observations each cell of each photo still wants.
class Wants {
 public:
  Wants(const Scene& scene, int per_photo)
      : scene_(scene),
        wanted_(scene.photos.size(),
                std::vector<int>(kCells * kCells, std::max(1, per_photo / (kCells * kCells)))) {}

  bool Wanted(const SceneTrack& track) {
    return std::any_of(track.elements.begin(), track.elements.end(),
                       [&](const SceneElement& e) { return e.used && Cell(e) > 0; });
  }
  void Take(const SceneTrack& track) {
    for (const SceneElement& e : track.elements) {
      if (e.used) --Cell(e);
    }
  }

 private:
  int& Cell(const SceneElement& element) {
    const Camera& camera = scene_.CameraOf(element.photo);
    const Eigen::Vector2d& pixel = scene_.photos[element.photo].keypoints[element.keypoint];
    const auto cell = [](double share) {
      return std::clamp(static_cast<int>(share * kCells), 0, kCells - 1);
    };
    return wanted_[element.photo]
                  [cell(pixel.y() / camera.height_px) * kCells + cell(pixel.x() / camera.width_px)];
  }

  const Scene& scene_;
  std::vector<std::vector<int>> wanted_;
};

}  // namespace

std::vector<int> ChooseTracks(const Scene& scene, int per_photo) {
  std::vector<std::pair<int, int>> order;  // (-observations, track)
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    const SceneTrack& track = scene.tracks[t];
    if (!track.position) continue;
    const auto used = std::count_if(track.elements.begin(), track.elements.end(),
                                    [](const SceneElement& e) { return e.used; });
    order.emplace_back(-static_cast<int>(used), static_cast<int>(t));
  }
  std::sort(order.begin(), order.end());
  Wants wants(scene, per_photo);
  std::vector<int> chosen;
  for (const auto& [observations, track] : order) {
    if (!wants.Wanted(scene.tracks[track])) continue;
    wants.Take(scene.tracks[track]);
    chosen.push_back(track);
  }
  if (3 * chosen.size() > 2 * order.size()) {
    chosen.clear();
    for (const auto& [observations, track] : order) chosen.push_back(track);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace stucco
