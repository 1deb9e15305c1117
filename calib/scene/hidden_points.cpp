// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/hidden_points.h"

#include <algorithm>
#include <boost/geometry.hpp>
#include <boost/geometry/geometries/point_xy.hpp>
#include <boost/geometry/index/rtree.hpp>
#include <iterator>
#include <utility>
#include <vector>

#include "calib/scene/triangulate.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

namespace index = boost::geometry::index;

constexpr size_t kNeighbours = 12;
constexpr int kNearer = 6;           // of these
constexpr double kMuchNearer = 0.5;  // of the distance
// Neighbours that are farther than this share of the picture's width say nothing.
constexpr double kBeside = 0.1;

struct Shown {
  int track = 0;
  double depth = 0;
};

using Pixel = boost::geometry::model::d2::point_xy<double>;
using Entry = std::pair<Pixel, size_t>;

// Those of the photo's tracks whose points lie behind what it shows around them.
std::vector<int> HiddenIn(const Scene& scene, int photo) {
  std::vector<Shown> shown;
  std::vector<Entry> entries;
  const Pose& pose = *scene.photos[photo].pose;
  for (size_t k = 0; k < scene.photos[photo].keypoints.size(); ++k) {
    const int track = scene.tracks_of_photo[photo][k];
    if (track < 0 || !scene.tracks[track].position) continue;
    const auto uses = [&](const SceneElement& e) {
      return e.used && e.photo == photo && e.keypoint == static_cast<int>(k);
    };
    const std::vector<SceneElement>& elements = scene.tracks[track].elements;
    if (std::ranges::none_of(elements, uses)) continue;
    const Eigen::Vector2d& pixel = scene.photos[photo].keypoints[k];
    entries.emplace_back(Pixel(pixel.x(), pixel.y()), shown.size());
    shown.push_back({track, (pose * *scene.tracks[track].position).z()});
  }
  std::vector<int> hidden;
  if (shown.size() <= kNeighbours) return hidden;
  const double beside_px = kBeside * scene.CameraOf(photo).width_px;
  const index::rtree<Entry, index::quadratic<16>> tree(entries);
  std::vector<Entry> near;
  for (const auto& [pixel, i] : entries) {
    near.clear();
    tree.query(index::nearest(pixel, kNeighbours + 1), std::back_inserter(near));
    const auto nearer = std::ranges::count_if(near, [&, from = pixel, own = i](const Entry& other) {
      return shown[other.second].depth < kMuchNearer * shown[own].depth &&
             boost::geometry::distance(other.first, from) < beside_px;
    });
    if (nearer >= kNearer) hidden.push_back(shown[i].track);
  }
  return hidden;
}

}  // namespace

int DropHiddenPoints(int threads, Scene& scene) {
  std::vector<std::vector<int>> hidden(scene.photos.size());
  ParallelFor(scene.photos.size(), threads, [&](size_t photo) {
    if (scene.photos[photo].pose) hidden[photo] = HiddenIn(scene, static_cast<int>(photo));
  });
  std::vector<int> votes(scene.tracks.size(), 0);
  for (const std::vector<int>& of_photo : hidden) {
    for (const int track : of_photo) ++votes[track];
  }
  int dropped = 0;
  for (size_t t = 0; t < votes.size(); ++t) {
    if (votes[t] == 0) continue;
    SceneTrack& track = scene.tracks[t];
    const auto used = std::ranges::count_if(track.elements, &SceneElement::used);
    if (2 * votes[t] < used) continue;
    ClearPoint(track);
    ++dropped;
  }
  return dropped;
}

}  // namespace stucco
