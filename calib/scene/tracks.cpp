// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/tracks.h"

#include <algorithm>
#include <cassert>
#include <cstdint>
#include <iterator>
#include <limits>
#include <numeric>
#include <span>
#include <utility>

#include "survey/disjoint_sets.h"
#include "survey/release.h"

namespace stucco {
namespace {

// Nodes are the matched keypoints of all photos, which are few of all; every set knows the photos
// in it.
class TrackForest {
 public:
  TrackForest(const std::vector<size_t>& num_keypoints, std::span<const PhotoPair* const> pairs)
      : offsets_(Offsets(num_keypoints)),
        node_(offsets_.back(), -1),
        keypoints_(Number(pairs)),
        sets_(keypoints_.size()),
        photos_(keypoints_.size()) {}

  int Node(int photo, int keypoint) const { return node_[IndexOf(photo, keypoint)]; }

  SceneElement Element(int node) const {
    const size_t index = keypoints_[node];
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), index);
    const int photo = static_cast<int>(next - offsets_.begin()) - 1;
    return {photo, static_cast<int>(index - offsets_[photo]), false};
  }

  int Root(int node) { return sets_.Find(node); }

  void Join(int a, int b) {
    const auto [low, high] = std::minmax({Root(a), Root(b)});
    if (low == high) return;
    const std::vector<int> photos_low = PhotosOf(low);
    const std::vector<int> photos_high = PhotosOf(high);
    std::vector<int> merged;
    std::merge(photos_low.begin(), photos_low.end(), photos_high.begin(), photos_high.end(),
               std::back_inserter(merged));
    if (std::adjacent_find(merged.begin(), merged.end()) != merged.end()) return;
    sets_.Join(low, high);
    photos_[low] = std::move(merged);
    Release(photos_[high]);
  }

  int size() const { return static_cast<int>(sets_.size()); }
  bool IsSingle(int root) const { return photos_[root].empty(); }

 private:
  // Of the first keypoint of each photo, and their number.
  static std::vector<size_t> Offsets(const std::vector<size_t>& num_keypoints) {
    std::vector<size_t> offsets(1, 0);
    for (const size_t count : num_keypoints) offsets.push_back(offsets.back() + count);
    return offsets;
  }

  size_t IndexOf(int photo, int keypoint) const {
    assert(keypoint >= 0 && offsets_[photo] + keypoint < offsets_[photo + 1]);
    return offsets_[photo] + keypoint;
  }

  // Numbers matched keypoints in their order. Returns which they are.
  std::vector<size_t> Number(std::span<const PhotoPair* const> pairs) {
    for (const PhotoPair* pair : pairs) {
      for (const Match& match : pair->matches) {
        node_[IndexOf(pair->first, match.first)] = 0;
        node_[IndexOf(pair->second, match.second)] = 0;
      }
    }
    std::vector<size_t> keypoints;
    for (size_t i = 0; i < node_.size(); ++i) {
      if (node_[i] < 0) continue;
      node_[i] = static_cast<int32_t>(keypoints.size());
      keypoints.push_back(i);
    }
    return keypoints;
  }

  std::vector<int> PhotosOf(int root) const {
    return photos_[root].empty() ? std::vector<int>{Element(root).photo} : photos_[root];
  }

  std::vector<size_t> offsets_;
  std::vector<int32_t> node_;      // by keypoint of all photos; -1 without a match
  std::vector<size_t> keypoints_;  // by node
  DisjointSets sets_;
  std::vector<std::vector<int>> photos_;  // of a root with more than one keypoint, ascending
};

}  // namespace

std::vector<SceneTrack> BuildTracks(const std::vector<size_t>& num_keypoints,
                                    std::vector<const PhotoPair*> pairs) {
  assert(std::accumulate(num_keypoints.begin(), num_keypoints.end(), size_t{0}) <=
         static_cast<size_t>(std::numeric_limits<int>::max()));
  std::stable_sort(pairs.begin(), pairs.end(), [](const PhotoPair* a, const PhotoPair* b) {
    return a->matches.size() > b->matches.size();
  });
  TrackForest forest(num_keypoints, pairs);
  for (const PhotoPair* pair : pairs) {
    for (const Match& match : pair->matches) {
      forest.Join(forest.Node(pair->first, match.first), forest.Node(pair->second, match.second));
    }
  }
  std::vector<int> track_of(forest.size(), -1);  // by root
  std::vector<SceneTrack> tracks;
  for (int node = 0; node < forest.size(); ++node) {
    const int root = forest.Root(node);
    if (forest.IsSingle(root)) continue;
    if (track_of[root] < 0) {
      track_of[root] = static_cast<int>(tracks.size());
      tracks.emplace_back();
    }
    tracks[track_of[root]].elements.push_back(forest.Element(node));
  }
  for (SceneTrack& track : tracks) track.elements.shrink_to_fit();
  return tracks;
}

void IndexTracks(Scene& scene) {
  scene.tracks_of_photo.clear();
  for (const ScenePhoto& photo : scene.photos) {
    scene.tracks_of_photo.emplace_back(photo.keypoints.size(), -1);
  }
  for (size_t t = 0; t < scene.tracks.size(); ++t) {
    for (const SceneElement& element : scene.tracks[t].elements) {
      scene.tracks_of_photo[element.photo][element.keypoint] = static_cast<int>(t);
    }
  }
}

}  // namespace stucco
