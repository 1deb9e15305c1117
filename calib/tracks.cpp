// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/tracks.h"

#include <algorithm>
#include <map>
#include <numeric>

namespace stucco {
namespace {

// Nodes are keypoints of all photos; every set knows the photos in it.
class TrackForest {
 public:
  explicit TrackForest(const std::vector<size_t>& num_keypoints) : offsets_(1, 0) {
    for (const size_t count : num_keypoints) offsets_.push_back(offsets_.back() + count);
    parent_.resize(offsets_.back());
    std::iota(parent_.begin(), parent_.end(), size_t{0});
    photos_.resize(parent_.size());
  }

  size_t Node(int photo, int keypoint) const { return offsets_[photo] + keypoint; }

  SceneElement Element(size_t node) const {
    const auto next = std::upper_bound(offsets_.begin(), offsets_.end(), node);
    const int photo = static_cast<int>(next - offsets_.begin()) - 1;
    return {photo, static_cast<int>(node - offsets_[photo]), false};
  }

  size_t Root(size_t node) {
    while (parent_[node] != node) node = parent_[node] = parent_[parent_[node]];
    return node;
  }

  void Join(size_t a, size_t b) {
    size_t root_a = Root(a);
    size_t root_b = Root(b);
    if (root_a == root_b) return;
    std::vector<int> photos_a = PhotosOf(root_a);
    std::vector<int> photos_b = PhotosOf(root_b);
    std::vector<int> merged;
    std::merge(photos_a.begin(), photos_a.end(), photos_b.begin(), photos_b.end(),
               std::back_inserter(merged));
    if (std::adjacent_find(merged.begin(), merged.end()) != merged.end()) return;
    if (root_b < root_a) std::swap(root_a, root_b);
    parent_[root_b] = root_a;
    photos_[root_a] = std::move(merged);
    photos_[root_b] = {};
  }

  size_t size() const { return parent_.size(); }
  bool IsSingle(size_t root) const { return photos_[root].empty(); }

 private:
  std::vector<int> PhotosOf(size_t root) const {
    return photos_[root].empty() ? std::vector<int>{Element(root).photo} : photos_[root];
  }

  std::vector<size_t> offsets_;
  std::vector<size_t> parent_;
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
  std::map<size_t, SceneTrack> by_root;
  for (size_t node = 0; node < forest.size(); ++node) {
    const size_t root = forest.Root(node);
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
