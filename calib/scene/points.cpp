// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/scene/points.h"

#include <algorithm>
#include <functional>
#include <numeric>
#include <utility>
#include <vector>

#include "survey/median.h"
#include "survey/parallel.h"

namespace stucco {
namespace {

constexpr size_t kTracksAtOnce = 2048;

// The sum of what `fn` returns.
int ForEachTrack(int threads, Scene& scene, const std::function<int(SceneTrack&)>& fn) {
  const size_t blocks = (scene.tracks.size() + kTracksAtOnce - 1) / kTracksAtOnce;
  std::vector<int> sums(blocks, 0);
  ParallelFor(blocks, threads, [&](size_t block) {
    const size_t end = std::min(scene.tracks.size(), (block + 1) * kTracksAtOnce);
    for (size_t t = block * kTracksAtOnce; t < end; ++t) sums[block] += fn(scene.tracks[t]);
  });
  return std::accumulate(sums.begin(), sums.end(), 0);
}

bool Fits(const Scene& scene, const SceneTrack& track, const SceneElement& element,
          double max_error_sigmas) {
  return ReprojectionErrorInSigmas(scene, element, *track.position) < max_error_sigmas;
}

// Nothing is in focus that is so much nearer than the middle one of a photo's points.
constexpr double kRightBeforeLens = 0.01;

// By photo, the distance that its points keep at least.
std::vector<double> LeastDistances(const Scene& scene, int threads) {
  std::vector<double> least(scene.photos.size(), 0);
  ParallelFor(least.size(), threads, [&](size_t photo) {
    if (!scene.photos[photo].pose) return;
    const Eigen::Vector3d centre = scene.photos[photo].pose->Center();
    std::vector<double> distances;
    for (const int track : TracksSeenBy(scene, static_cast<int>(photo))) {
      distances.push_back((*scene.tracks[track].position - centre).norm());
    }
    least[photo] = kRightBeforeLens * Median(std::move(distances)).value_or(0);
  });
  return least;
}

bool IsRightBeforeALens(const Scene& scene, const std::vector<double>& least,
                        const SceneTrack& track) {
  return std::ranges::any_of(track.elements, [&](const SceneElement& element) {
    return element.used && (*track.position - scene.photos[element.photo].pose->Center()).norm() <
                               least[element.photo];
  });
}

}  // namespace

int TriangulateMissing(const TriangulateOptions& options, int threads, Scene& scene) {
  return ForEachTrack(threads, scene, [&](SceneTrack& track) {
    return !track.position && TriangulateTrack(scene, options, track) ? 1 : 0;
  });
}

int TriangulateAll(const TriangulateOptions& options, int threads, Scene& scene) {
  return ForEachTrack(threads, scene, [&](SceneTrack& track) {
    return TriangulateTrack(scene, options, track) ? 1 : 0;
  });
}

void CompleteTracks(double max_error_sigmas, int threads, Scene& scene) {
  ForEachTrack(threads, scene, [&](SceneTrack& track) {
    if (!track.position) return 0;
    for (SceneElement& element : track.elements) {
      element.used = Fits(scene, track, element, max_error_sigmas);
    }
    return 0;
  });
}

int FilterPoints(const TriangulateOptions& options, int threads, Scene& scene) {
  const std::vector<double> least = LeastDistances(scene, threads);
  return ForEachTrack(threads, scene, [&](SceneTrack& track) {
    if (!track.position) return 0;
    int used = 0;
    int dropped = 0;
    for (SceneElement& element : track.elements) {
      if (!element.used) continue;
      element.used = Fits(scene, track, element, options.max_error_sigmas);
      ++(element.used ? used : dropped);
    }
    if (used >= 2 && LargestRayAngle(scene, track) >= options.min_angle_rad &&
        !IsRightBeforeALens(scene, least, track)) {
      return dropped;
    }
    ClearPoint(track);
    return dropped + used;
  });
}

}  // namespace stucco
