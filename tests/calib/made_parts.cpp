// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "tests/calib/made_parts.h"

#include <utility>

#include "calib/records/georeference.h"
#include "calib/scene/tracks.h"

namespace stucco::test {

Scene Joined(const Scene& first, const Scene& second, const Eigen::Vector3d& shift) {
  Scene moved = second;
  Similarity by;
  by.translation = shift;
  Transform(by, moved);
  Scene both = first;
  const int offset = static_cast<int>(first.photos.size());
  for (ScenePhoto& photo : moved.photos) {
    photo.name = "other/" + photo.name;
    both.photos.push_back(std::move(photo));
  }
  for (SceneTrack& track : moved.tracks) {
    for (SceneElement& e : track.elements) e.photo += offset;
    both.tracks.push_back(std::move(track));
  }
  IndexTracks(both);
  return both;
}

Scene Unmatched(const Scene& scene, int begin) {
  Scene parted = scene;
  parted.tracks.clear();
  for (const SceneTrack& track : scene.tracks) {
    for (const bool second : {false, true}) {
      SceneTrack half = track;
      std::erase_if(half.elements,
                    [&](const SceneElement& e) { return (e.photo >= begin) != second; });
      if (half.elements.size() >= 2) parted.tracks.push_back(std::move(half));
    }
  }
  IndexTracks(parted);
  return parted;
}

}  // namespace stucco::test
