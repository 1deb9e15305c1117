// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/tracks.h"

#include <algorithm>
#include <cassert>
#include <iterator>
#include <map>

#include "survey/disjoint_sets.h"

namespace stucco {
namespace {

// Nodes are keypoints of all photos; every set knows the photos in it.
class TrackForest {
 public:
  explicit TrackForest(const std::vector<size_t>& num_keypoints)
      : offsets_(Offsets(num_keypoints)), sets_(offsets_.back()), photos_(offsets_.back()) {}

  int Node(int photo, int keypoint) const {
    assert(keypoint >= 0 && offsets_[photo] + keypoint < offsets_[photo + 1]);
    return static_cast<int>(offsets_[photo]) + keypoint;
  }

  SceneElement Element(int node) const {
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), static_cast<size_t>(node));
    const int photo = static_cast<int>(next - offsets_.begin()) - 1;
    return {photo, node - static_cast<int>(offsets_[photo]), false};
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
    photos_[high] = {};
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

  std::vector<int> PhotosOf(int root) const {
    return photos_[root].empty() ? std::vector<int>{Element(root).photo} : photos_[root];
  }

  std::vector<size_t> offsets_;
  DisjointSets sets_;
  std::vector<std::vector<int>> photos_;  // of a root with more than one keypoint, ascending
};

}  // namespace

std::vector<SceneTrack> BuildTracks(const std::vector<size_t>& num_keypoints,
                                    std::vector<PhotoPair> pairs) {
  std::stable_sort(pairs.begin(), pairs.end(), [](const PhotoPair& a, const PhotoPair& b) {
    return a.matches.size() > b.matches.size();
  });
  TrackForest forest(num_keypoints);
  for (const PhotoPair& pair : pairs) {
    for (const Match& match : pair.matches) {
      forest.Join(forest.Node(pair.first, match.first), forest.Node(pair.second, match.second));
    }
  }
  std::map<int, SceneTrack> by_root;
  for (int node = 0; node < forest.size(); ++node) {
    const int root = forest.Root(node);
    if (!forest.IsSingle(root)) by_root[root].elements.push_back(forest.Element(node));
  }
  std::vector<SceneTrack> tracks;
  tracks.reserve(by_root.size());
  for (auto& [root, track] : by_root) tracks.push_back(std::move(track));
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
