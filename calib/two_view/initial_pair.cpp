// SPDX-FileCopyrightText: 2026 the Stucco authors
// SPDX-License-Identifier: GPL-3.0-or-later
#include "calib/two_view/initial_pair.h"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

#include "calib/two_view/pair_rays.h"
#include "survey/disjoint_sets.h"
#include "survey/median.h"

namespace stucco {
namespace {

// A pair is a rotation when this share of its epipolar inliers turns with one rotation.
constexpr double kRotationShare = 0.85;
constexpr double kGoodAngle = 12 * std::numbers::pi / 180;
constexpr double kLeastAngle = 2 * std::numbers::pi / 180;
constexpr double kClearParallax = 0.5 * std::numbers::pi / 180;
constexpr int kLeastInliers = 30;
// Pairs with most matches that are tried first, and pairs tried when these give too few initial
// ones.
constexpr size_t kBestPairs = 40;
constexpr size_t kOtherPairs = 200;

// True when both photos have poses and the rays of their common points meet at a clear angle.
bool HasParallax(const Scene& scene, const PhotoPair& pair) {
  const auto& first = scene.photos[pair.first].pose;
  const auto& second = scene.photos[pair.second].pose;
  if (!first || !second) return false;
  std::vector<double> angles;
  for (const Match& match : pair.matches) {
    const int track = scene.tracks_of_photo[pair.first][match.first];
    if (track < 0 || !scene.tracks[track].position) continue;
    const Eigen::Vector3d a = *scene.tracks[track].position - first->Center();
    const Eigen::Vector3d b = *scene.tracks[track].position - second->Center();
    angles.push_back(std::atan2(a.cross(b).norm(), a.dot(b)));
  }
  return angles.size() >= kLeastInliers && *Median(std::move(angles)) > kClearParallax;
}

struct ScoredPair {
  double score = 0;
  InitialPair pair;
};

std::optional<ScoredPair> Score(const Scene& scene, const VerifiedPair& candidate,
                                double max_error_sigmas) {
  const PairRays rays = RaysOf(scene, candidate.pair, max_error_sigmas);
  const auto relative = EstimateRelativePose(rays.first, rays.second, rays.max_error);
  if (!relative || relative->num_inliers < kLeastInliers) return std::nullopt;
  if (relative->median_angle_rad < kLeastAngle) return std::nullopt;
  const double angle = std::min(1.0, relative->median_angle_rad / kGoodAngle);
  return ScoredPair{relative->num_inliers * angle,
                    {candidate.pair.first, candidate.pair.second, *relative}};
}

// Pairs that may start a reconstruction, those with most matches first.
std::vector<const VerifiedPair*> InitialCandidates(const std::vector<VerifiedPair>& pairs) {
  std::vector<const VerifiedPair*> candidates;
  for (const VerifiedPair& pair : pairs) {
    if (!pair.rotation_only && pair.pair.matches.size() >= kLeastInliers)
      candidates.push_back(&pair);
  }
  // Pairs that a single homography explains come last: a plane fits two relative poses.
  const auto worth = [](const VerifiedPair* p) {
    return static_cast<double>(p->pair.matches.size()) -
           (p->geometry.num_homography > 0.8 * p->pair.matches.size() ? 1e6 : 0);
  };
  std::stable_sort(candidates.begin(), candidates.end(),
                   [&](const auto* a, const auto* b) { return worth(a) > worth(b); });
  return candidates;
}

}  // namespace

void ClassifyMotion(const Scene& scene, double max_error_sigmas, VerifiedPair& pair) {
  pair.rotation_only = false;
  // A rotation is a homography: without one that most matches agree with there is nothing to look
  // for.
  const int count = static_cast<int>(pair.pair.matches.size());
  if (pair.geometry.num_homography < 0.6 * count) return;
  const PairRays rays = RaysOf(scene, pair.pair, max_error_sigmas);
  // Twice the tolerance: the focal length may still be a guess, which bends a rotation by some
  // pixels.
  const int by_rotation = CountRotationInliers(rays.first, rays.second, 2 * rays.max_error,
                                               pair.pair.first * 65536 + pair.pair.second);
  pair.rotation_only = by_rotation >= kRotationShare * count;
}

std::vector<std::vector<int>> RotationGroups(const Scene& scene,
                                             const std::vector<VerifiedPair>& pairs) {
  const int num_photos = static_cast<int>(scene.photos.size());
  DisjointSets groups(scene.photos.size());
  for (const VerifiedPair& pair : pairs) {
    if (!pair.rotation_only || HasParallax(scene, pair.pair)) continue;
    groups.Join(pair.pair.first, pair.pair.second);
  }
  std::vector<std::vector<int>> members(num_photos);
  for (int photo = 0; photo < num_photos; ++photo) members[groups.Find(photo)].push_back(photo);
  std::erase_if(members, [](const std::vector<int>& m) { return m.size() < 3; });
  return members;
}

std::vector<InitialPair> FindInitialPairs(const Scene& scene,
                                          const std::vector<VerifiedPair>& pairs,
                                          double max_error_sigmas, int max_initial_pairs) {
  const std::vector<const VerifiedPair*> candidates = InitialCandidates(pairs);
  std::vector<ScoredPair> scored;
  const auto try_candidate = [&](const VerifiedPair& candidate) {
    if (auto pair = Score(scene, candidate, max_error_sigmas)) scored.push_back(*pair);
  };
  const size_t num_best = std::min(candidates.size(), kBestPairs);
  for (size_t i = 0; i < num_best; ++i) try_candidate(*candidates[i]);
  // Where photos follow each other closely the most alike have too small an angle: look further
  // down, evenly.
  const size_t step = (candidates.size() - num_best) / kOtherPairs + 1;
  for (size_t i = num_best; i < candidates.size(); i += step) {
    if (static_cast<int>(scored.size()) >= max_initial_pairs) break;
    try_candidate(*candidates[i]);
  }
  std::stable_sort(scored.begin(), scored.end(),
                   [](const auto& a, const auto& b) { return a.score > b.score; });
  std::vector<InitialPair> best;
  for (const ScoredPair& each : scored) {
    if (static_cast<int>(best.size()) < max_initial_pairs) best.push_back(each.pair);
  }
  return best;
}

}  // namespace stucco
