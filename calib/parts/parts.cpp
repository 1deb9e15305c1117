// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/parts/parts.h"

#include <algorithm>
#include <map>
#include <utility>

#include "calib/scene/tracks.h"
#include "calib/scene/triangulate.h"
#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

// Joins groups that share enough points as they are now; false where there were none.
bool JoinGroups(const Scene& scene, int least_points, DisjointSets& groups) {
  std::map<std::pair<int, int>, int> shared;
  std::vector<int> seen_by;
  for (const SceneTrack& track : scene.tracks) {
    if (!track.position) continue;
    seen_by.clear();
    for (const SceneElement& e : track.elements) {
      if (e.used) seen_by.push_back(groups.Find(e.photo));
    }
    std::ranges::sort(seen_by);
    seen_by.erase(std::unique(seen_by.begin(), seen_by.end()), seen_by.end());
    for (size_t i = 0; i < seen_by.size(); ++i) {
      for (size_t j = i + 1; j < seen_by.size(); ++j) ++shared[{seen_by[i], seen_by[j]}];
    }
  }
  bool any = false;
  for (const auto& [pair, count] : shared) {
    if (count >= least_points) any = groups.Join(pair.first, pair.second) || any;
  }
  return any;
}

void ClearIfLost(SceneTrack& track) {
  if (track.position && std::ranges::count_if(track.elements, &SceneElement::used) < 2) {
    ClearPoint(track);
  }
}

}  // namespace

std::vector<std::vector<int>> TiedGroups(const Scene& scene, int least_points) {
  DisjointSets sets(scene.photos.size());
  while (JoinGroups(scene, least_points, sets)) {
  }
  std::map<int, std::vector<int>> by_first;
  for (int i = 0; i < static_cast<int>(scene.photos.size()); ++i) {
    if (scene.photos[i].pose) by_first[sets.Find(i)].push_back(i);
  }
  std::vector<std::vector<int>> groups;
  groups.reserve(by_first.size());
  for (auto& [first, photos] : by_first) groups.push_back(std::move(photos));
  std::ranges::stable_sort(groups, std::ranges::greater{}, &std::vector<int>::size);
  return groups;
}

Scene SceneOf(const Scene& scene, const std::vector<int>& photos) {
  std::vector<bool> is_in(scene.photos.size(), false);
  for (const int photo : photos) is_in[photo] = true;
  Scene part;
  part.cameras = scene.cameras;
  part.photos.resize(scene.photos.size());
  for (size_t i = 0; i < scene.photos.size(); ++i) {
    part.photos[i].name = scene.photos[i].name;
    part.photos[i].camera = scene.photos[i].camera;
    if (is_in[i]) part.photos[i] = scene.photos[i];
  }
  for (const SceneTrack& track : scene.tracks) {
    SceneTrack kept = track;
    std::erase_if(kept.elements, [&](const SceneElement& e) { return !is_in[e.photo]; });
    if (kept.elements.size() < 2) continue;
    ClearIfLost(kept);
    part.tracks.push_back(std::move(kept));
  }
  IndexTracks(part);
  return part;
}

void TakePoses(const std::vector<int>& photos, Scene& scene) {
  for (const int photo : photos) scene.photos[photo].pose.reset();
  for (SceneTrack& track : scene.tracks) {
    for (SceneElement& e : track.elements) e.used = e.used && scene.photos[e.photo].pose;
    ClearIfLost(track);
  }
}

}  // namespace stucco
